#include "config/case_document.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

std::string position(std::string_view name, const toml::source_position& where) {
  return where ? fmt::format("{}:{}:{}", name, where.line, where.column) : std::string(name);
}

bool is_bare_word(std::string_view text) {
  return !text.empty() && text.find_first_of("\"'[]{},=#\n\r") == std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// {value = ...}
toml::table parse_override_value(std::string_view text, const std::string& place) {
  try {
    toml::table parsed = toml::parse(fmt::format("value = {}", text));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error& error) {
    if (is_bare_word(text)) return toml::table{{"value", std::string(text)}};
    throw ConfigError(fmt::format("{}: {}", place, error.description()));
  }
  throw ConfigError(fmt::format("{}: must be one value", place));
}

}  // namespace

CaseDocument::CaseDocument(std::string_view text, std::string_view name,
                           std::span<const std::string> overrides)
    : name_(name) {
  try {
    root_ = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(
        fmt::format("{}: {}", position(name, error.source().begin), error.description()));
  }
  for (const std::string& override_text : overrides) apply(override_text);
}

std::string CaseDocument::place(const std::string& key, const toml::source_region& region) const {
  const auto found = overridden_.find(key);
  return found == overridden_.end() ? position(name_, region.begin) : found->second;
}

void CaseDocument::apply(const std::string& text) {
  const std::string place = "--set " + text;
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    throw ConfigError(fmt::format("{}: must be table.key=value", place));
  const std::string path(trimmed(std::string_view(text).substr(0, equals)));
  const toml::table value =
      parse_override_value(trimmed(std::string_view(text).substr(equals + 1)), place);

  const auto dot = path.find('.');
  toml::table* target = &root_;
  if (dot != std::string::npos) {
    const std::string table_name = path.substr(0, dot);
    if (!root_.contains(table_name)) {
      root_.insert(table_name, toml::table{});
      overridden_[table_name] = place;
    }
    target = root_[table_name].as_table();
    if (target == nullptr)
      throw ConfigError(fmt::format("{}: {} must be a table", place, table_name));
  }
  target->insert_or_assign(dot == std::string::npos ? path : path.substr(dot + 1),
                           *value.get("value"));
  overridden_[path] = place;
}

void Entry::refuse(std::string_view rule) const {
  throw ConfigError(fmt::format("{}: {} = {}: {}", place, key, value_text(node), rule));
}

std::string value_text(const toml::node& node) {
  if (node.is_floating_point()) return fmt::format("{}", node.value<double>().value());
  if (const auto* array = node.as_array()) {
    std::vector<std::string> elements;
    for (const auto& element : *array) elements.push_back(value_text(element));
    return fmt::format("[ {} ]", fmt::join(elements, ", "));
  }
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return std::move(out).str();
}

}  // namespace vesica::config
