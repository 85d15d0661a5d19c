#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "config/option_values.hpp"
#include "vesica/config/config.hpp"

namespace vesica::config {

/// The words a, b, c of a meaning "a, b: ...; c: ...".
[[nodiscard]] std::vector<std::string_view> names_before_colons(const Field& field);

/// Whether a field means something for an alternative, the kind of a shape for example. The meaning
/// of a field begins with the alternatives that use it, "kind, kind: ...; kind: ..."; where it
/// begins otherwise all do.
template <class Alternative>
bool is_used_by(const Field& field, Alternative chosen) {
  std::vector<std::string_view> users = names_before_colons(field);
  std::erase_if(users, [](std::string_view name) {
    const auto& names = EnumNames<Alternative>::names;
    return std::none_of(names.begin(), names.end(),
                        [name](const auto& known) { return known.second == name; });
  });
  return users.empty() || std::find(users.begin(), users.end(), name_of(chosen)) != users.end();
}

/// The fields that differ from their defaults but mean nothing for the alternative.
template <class Options, class Alternative>
std::vector<Field> unused_fields(const Options& options, Alternative chosen) {
  const Options defaults;
  std::vector<std::string> texts;
  Options::fields(defaults,
                  [&](const Field&, const auto& value) { texts.push_back(toml_text(value)); });
  std::vector<Field> unused;
  std::size_t i = 0;
  Options::fields(options, [&](const Field& field, const auto& value) {
    const bool is_changed = toml_text(value) != texts[i++];
    if (is_changed && !is_used_by(field, chosen)) unused.push_back(field);
  });
  return unused;
}

}  // namespace vesica::config
