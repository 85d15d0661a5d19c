#pragma once

#include <string>
#include <vector>

#include "io/option_values.hpp"
#include "vesica/io/config.hpp"

namespace vesica::io {

/// The fields that differ from their defaults.
template <class Options>
std::vector<Field> changed_fields(const Options& options) {
  const Options defaults;
  std::vector<std::string> texts;
  Options::fields(defaults,
                  [&](const Field&, const auto& value) { texts.push_back(toml_text(value)); });
  std::vector<Field> changed;
  std::size_t i = 0;
  Options::fields(options, [&](const Field& field, const auto& value) {
    if (toml_text(value) != texts[i++]) changed.push_back(field);
  });
  return changed;
}

/// One sentence for each changed key of [shape] and [phase] that belongs to another kind.
[[nodiscard]] std::vector<std::string> unused_options(const RunConfig& config);

}  // namespace vesica::io
