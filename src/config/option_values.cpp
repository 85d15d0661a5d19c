#include "config/option_values.hpp"

#include <fmt/ranges.h>

#include <cstdint>
#include <limits>

namespace vesica::config {
namespace {

double number(const Entry& entry, const toml::node& node, std::string_view expected) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) entry.refuse(expected);
  return *value;
}

Eigen::Vector3d vector(const Entry& entry, const toml::node& node, std::string_view expected) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) entry.refuse(expected);
  return {number(entry, *array->get(0), expected), number(entry, *array->get(1), expected),
          number(entry, *array->get(2), expected)};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      out += '\\';
      out += character;
    } else if (static_cast<unsigned char>(character) < 0x20 || character == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(character));
    } else {
      out += character;
    }
  }
  return out;
}

}  // namespace

void assign(const Entry& entry, bool& target) {
  if (!entry.node.is_boolean()) entry.refuse("must be true or false");
  target = entry.node.value<bool>().value();
}

void assign(const Entry& entry, int& target) {
  if (!entry.node.is_integer()) entry.refuse("must be an integer");
  const std::int64_t value = entry.node.value<std::int64_t>().value();
  if (value > std::numeric_limits<int>::max() || value < std::numeric_limits<int>::min()) {
    entry.refuse("must fit into 32 bits");
  }
  target = static_cast<int>(value);
}

void assign(const Entry& entry, double& target) {
  target = number(entry, entry.node, "must be a number");
}

void assign(const Entry& entry, std::string& target) {
  if (!entry.node.is_string()) entry.refuse("must be a string");
  target = entry.node.value<std::string>().value();
}

void assign(const Entry& entry, Eigen::Vector3d& target) {
  target = vector(entry, entry.node, "must be an array of 3 numbers");
}

void assign(const Entry& entry, std::vector<Eigen::Vector3d>& target) {
  constexpr std::string_view expected = "must be an array of arrays of 3 numbers";
  const toml::array* array = entry.node.as_array();
  if (array == nullptr) entry.refuse(expected);
  std::vector<Eigen::Vector3d> vectors;
  for (const toml::node& element : *array) vectors.push_back(vector(entry, element, expected));
  target = std::move(vectors);
}

void assign(const Entry& entry, solve::TimeStep& target) {
  const std::string expected =
      fmt::format("must be a number or \"{}\"", solve::TimeStep::from_interface_width);
  if (entry.node.is_string()) {
    if (entry.node.value<std::string>().value() != solve::TimeStep::from_interface_width)
      entry.refuse(expected);
    target = {};
    return;
  }
  target.value = number(entry, entry.node, expected);
}

std::size_t index_of_name(const Entry& entry, const std::vector<std::string>& names) {
  const std::string list = fmt::format("must be one of \"{}\"", fmt::join(names, "\", \""));
  if (!entry.node.is_string()) entry.refuse(list);
  const std::string word = entry.node.value<std::string>().value();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) return i;
  }
  const auto nearest = nearest_name(word, names);
  entry.refuse(nearest ? fmt::format("{}; did you mean \"{}\"?", list, *nearest) : list);
}

std::string toml_text(bool value) { return value ? "true" : "false"; }

std::string toml_text(int value) { return fmt::format("{}", value); }

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(const std::string& value) { return fmt::format("\"{}\"", escaped(value)); }

std::string toml_text(const Eigen::Vector3d& value) {
  return fmt::format("[{}, {}, {}]", toml_text(value.x()), toml_text(value.y()),
                     toml_text(value.z()));
}

std::string toml_text(const std::vector<Eigen::Vector3d>& value) {
  std::vector<std::string> texts;
  for (const Eigen::Vector3d& vector : value) texts.push_back(toml_text(vector));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string toml_text(const solve::TimeStep& value) {
  if (value.value) return toml_text(*value.value);
  return toml_text(std::string(solve::TimeStep::from_interface_width));
}

}  // namespace vesica::config
