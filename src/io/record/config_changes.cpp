#include "io/record/config_changes.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "config/option_values.hpp"

namespace vesica::io {
namespace {

using Values = std::map<std::string, std::string>;

/// Collects the options of a table by their names.
class Collector {
 public:
  Collector(Values& values, std::string_view table) : values_(values), table_(table) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    values_[fmt::format("{}.{}", table_, field.name)] = config::toml_text(value);
  }
  template <class T>
  void operator()(const Field& field, const std::optional<T>& value) {
    if (value) (*this)(field, *value);
  }

 private:
  Values& values_;
  std::string_view table_;
};

Values values_of(const config::RunConfig& config) {
  Values values;
  config::RunConfig::tables(
      config, [&values]<class Options>(const config::Table& table, const Options& options) {
        if constexpr (requires { options.has_value(); }) {
          if (options) Options::value_type::fields(*options, Collector(values, table.name));
        } else {
          Options::fields(options, Collector(values, table.name));
        }
      });
  values.erase("output.directory");
  return values;
}

}  // namespace

std::vector<ConfigChange> changes_between(const config::RunConfig& before,
                                          const config::RunConfig& after) {
  std::vector<ConfigChange> changes;
  Values old_values = values_of(before);
  for (const auto& [key, value] : values_of(after)) {
    const std::string old_value = old_values[key];
    if (old_value != value) changes.push_back({key, old_value, value});
    old_values.erase(key);
  }
  for (const auto& [key, value] : old_values) changes.push_back({key, value, ""});
  return changes;
}

}  // namespace vesica::io
