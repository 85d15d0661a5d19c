#include "shapes/formats/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace vesica::shapes {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// std::from_chars does not take the plus sign that files may have.
template <class T>
bool parse(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

bool TextLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    ++line_;
    words_ = split(line.substr(0, line.find('#')));
  }
  return !words_.empty();
}

long long TextLines::integer(std::string_view word) const {
  long long value = 0;
  if (!parse(word, value)) refuse("'{}': must be an integer", word);
  return value;
}

double TextLines::finite_number(std::string_view word) const {
  double value = 0;
  if (!parse(word, value) || !std::isfinite(value)) refuse("'{}': must be a finite number", word);
  return value;
}

Eigen::Vector3d TextLines::point(std::size_t first) const {
  return {finite_number(words_[first]), finite_number(words_[first + 1]),
          finite_number(words_[first + 2])};
}

}  // namespace vesica::shapes
