#include "phase_file.hpp"

#include <fmt/format.h>

#include <algorithm>
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

void check_count(const GivenNumbers& given, const mesh::Triangulation& triangulation) {
  const auto num_vertices = static_cast<std::size_t>(triangulation.num_vertices());
  const auto num_nodes = static_cast<std::size_t>(triangulation.num_nodes());
  const std::size_t count = given.values.size();
  if (count == num_vertices || count == num_nodes) return;
  const std::string rule =
      fmt::format("must be one for each of the {} vertices or of the {} nodes (vertices and edges)",
                  num_vertices, num_nodes);
  if (count > num_nodes) {
    throw ConfigError(
        fmt::format("{}: value number {}: {}", given.place(num_nodes), num_nodes + 1, rule));
  }
  throw ConfigError(fmt::format(
      "{}: ends after {} values: {}",
      given.lines.empty() ? given.source : fmt::format("{}:{}", given.source, given.last_line),
      count, rule));
}

/// Whether both numbers occur, and no other.
bool are_labels(const std::vector<double>& values, double first, double second) {
  const auto has = [&](double label) { return std::ranges::count(values, label); };
  const auto firsts = has(first);
  const auto seconds = has(second);
  return firsts > 0 && seconds > 0 && firsts + seconds == std::ssize(values);
}

/// Maps labels onto c = 1 and c = -1, and says so.
void map_labels(std::vector<double>& values, const std::string& source,
                std::vector<std::string>& notes) {
  for (const double other : {0.0, 2.0}) {
    if (!are_labels(values, 1, other)) continue;
    for (double& value : values) value = value == 1 ? 1 : -1;
    notes.push_back(fmt::format(
        "{}: the values are the labels 1 and {:g}: 1 becomes phase 1 (c = 1), {:g} phase 2 (c = "
        "-1)",
        source, other, other));
  }
}

void check_range(const GivenNumbers& given, const std::vector<double>& values) {
  constexpr double largest = 1.05;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= largest) continue;
    throw ConfigError(
        fmt::format("{}: {:g}: must be in [-1, 1] (up to {:g} counts as overshoot), or all values "
                    "the labels 0 and 1, or 1 and 2",
                    given.place(i), values[i], largest));
  }
}

/// Values at all nodes from those at the corners, which come in the order of their nodes.
Eigen::VectorXd with_midpoints(const Eigen::VectorXd& at_vertices,
                               const mesh::Triangulation& triangulation) {
  std::vector<char> is_corner(static_cast<std::size_t>(triangulation.num_nodes()), 0);
  for (const mesh::QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) is_corner[static_cast<std::size_t>(nodes[i])] = 1;
  }
  Eigen::VectorXd values(triangulation.num_nodes());
  Eigen::Index vertex = 0;
  for (Eigen::Index node = 0; node < values.size(); ++node) {
    if (is_corner[static_cast<std::size_t>(node)] != 0) values[node] = at_vertices[vertex++];
  }
  for (const mesh::QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t i = 0; i < 3; ++i)
      values[nodes[3 + i]] = 0.5 * (values[nodes[i]] + values[nodes[(i + 1) % 3]]);
  }
  return values;
}

}  // namespace

std::string GivenNumbers::place(std::size_t i) const {
  return lines.empty() ? fmt::format("{}: value number {}", source, i + 1)
                       : fmt::format("{}:{}", source, lines[i]);
}

GivenNumbers read_phase_file(const std::string& path) {
  auto stream = open(path);
  GivenNumbers numbers;
  numbers.source = path;
  std::string text;
  while (std::getline(stream, text)) {
    ++numbers.last_line;
    const auto word = content(text);
    if (word.empty()) continue;
    numbers.values.push_back(parse(word, path, numbers.last_line));
    numbers.lines.push_back(numbers.last_line);
  }
  if (stream.bad()) throw IoError(fmt::format("{}: cannot be read", path));
  return numbers;
}

GivenNumbers numbers_of(const mesh::PointField& field) {
  GivenNumbers numbers;
  numbers.source = field.source;
  numbers.values.assign(field.values.begin(), field.values.end());
  for (std::size_t i = 0; i < numbers.values.size(); ++i) {
    if (std::isfinite(numbers.values[i])) continue;
    throw ConfigError(
        fmt::format("{}: {}: must be a finite number", numbers.place(i), numbers.values[i]));
  }
  return numbers;
}

PhaseStart order_parameter_of(const GivenNumbers& given, const mesh::Triangulation& triangulation) {
  check_count(given, triangulation);
  PhaseStart start;
  std::vector<double> values = given.values;
  map_labels(values, given.source, start.notes);
  check_range(given, values);
  const Eigen::Map<const Eigen::VectorXd> c(values.data(), std::ssize(values));
  start.order_parameter =
      c.size() == triangulation.num_nodes() ? Eigen::VectorXd(c) : with_midpoints(c, triangulation);
  return start;
}

}  // namespace vesica::phase
