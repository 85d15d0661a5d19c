#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"

namespace vesica::io {

/// A number of a result.
struct Number {
  std::string path;  ///< "mesh/quality"
  std::string_view unit;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN when it is absent
  bool is_count = false;

  /// Returns the last part of the path in words, "normal velocity".
  [[nodiscard]] std::string name() const {
    std::string words = path.substr(path.rfind('/') + 1);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
  }
  [[nodiscard]] bool is_in(std::string_view group) const {
    return path.size() > group.size() && path.starts_with(group) && path[group.size()] == '/';
  }
};

/// Collects the numbers of a result, those of lists left out.
class NumberCollector {
 public:
  explicit NumberCollector(std::vector<Number>& numbers, std::string group = "")
      : numbers_(numbers), group_(std::move(group)) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    std::string path = group_;
    if (!path.empty() && !field.name.empty()) path += '/';
    path += field.name;
    if constexpr (HasFields<T>) {
      T::fields(value, NumberCollector(numbers_, std::move(path)));
    } else if constexpr (std::is_arithmetic_v<T>) {
      numbers_.push_back(
          {std::move(path), field.unit, static_cast<double>(value), std::is_integral_v<T>});
    }
  }
  template <class T>
  void operator()(const Field& field, const std::optional<T>& value) {
    if (value) return (*this)(field, *value);
    const std::size_t first = numbers_.size();
    (*this)(field, T{});
    for (std::size_t i = first; i < numbers_.size(); ++i) numbers_[i].value = Number{}.value;
  }

 private:
  std::vector<Number>& numbers_;
  std::string group_;
};

/// Returns the numbers of a result in the order of its fields.
template <HasFields Result>
[[nodiscard]] std::vector<Number> numbers_of(const Result& result) {
  std::vector<Number> numbers;
  Result::fields(result, NumberCollector(numbers));
  return numbers;
}

}  // namespace vesica::io
