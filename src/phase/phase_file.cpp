#include "phase_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "vesica/core/error.hpp"

namespace vesica::phase {
namespace {

std::ifstream open(const std::string& path) {
  if (path.empty()) throw ConfigError("phase.path = \"\": must name a file");
  if (std::error_code error; std::filesystem::is_directory(path, error)) {
    throw IoError(fmt::format("{}: cannot be read: it is a folder", path));
  }
  std::ifstream stream(path);
  if (!stream) throw IoError(fmt::format("{}: cannot be opened for reading", path));
  return stream;
}

/// The line without comment and without blanks at its ends.
std::string_view content(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\v\f";
  line = line.substr(0, line.find('#'));
  const auto begin = line.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(blanks) - begin + 1);
}

double parse(std::string_view word, const std::string& path, int line) {
  // std::from_chars does not take the plus sign that files may have
  const auto digits = word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
    throw ConfigError(fmt::format("{}:{}: '{}': must be one finite number", path, line, word));
  }
  return value;
}

}  // namespace

Eigen::VectorXd read_phase_file(const std::string& path, Eigen::Index num_nodes) {
  auto stream = open(path);
  Eigen::VectorXd values(num_nodes);
  Eigen::Index count = 0;
  std::string text;
  int line = 0;
  while (std::getline(stream, text)) {
    ++line;
    const auto word = content(text);
    if (word.empty()) continue;
    const double value = parse(word, path, line);
    if (count == num_nodes) {
      throw ConfigError(fmt::format("{}:{}: value number {}: must be one for each of the {} nodes",
                                    path, line, count + 1, num_nodes));
    }
    values[count++] = value;
  }
  if (stream.bad()) throw IoError(fmt::format("{}: cannot be read", path));
  if (count < num_nodes) {
    throw ConfigError(
        fmt::format("{}:{}: ends after {} values: must be one for each of the {} nodes", path, line,
                    count, num_nodes));
  }
  return values;
}

}  // namespace vesica::phase
