#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/error.hpp"

namespace vesica::shapes {

/// Goes through a text line by line; `#` starts a comment, lines without words are passed over.
class TextLines {
 public:
  TextLines(std::string path, std::string_view text) : path_(std::move(path)), rest_(text) {}

  /// Moves to the next line with words; false at the end of the text.
  bool next();

  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t line() const { return line_; }

  /// Throws ConfigError `path:line: text`.
  template <class... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    throw ConfigError(
        fmt::format("{}:{}: {}", path_, line_, fmt::format(text, std::forward<Args>(args)...)));
  }

  /// A word of the current line as a number; throws ConfigError when it is none.
  [[nodiscard]] long long integer(std::string_view word) const;
  [[nodiscard]] double finite_number(std::string_view word) const;
  /// Three words from `first` on.
  [[nodiscard]] Eigen::Vector3d point(std::size_t first) const;

 private:
  std::string path_;
  std::string_view rest_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace vesica::shapes
