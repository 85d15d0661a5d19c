#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vesica::config {

/// A parsed case file with its overrides merged in. Knows where each value was written.
class CaseDocument {
 public:
  /// Throws ConfigError for malformed TOML and malformed overrides.
  CaseDocument(std::string_view text, std::string_view name,
               std::span<const std::string> overrides);

  [[nodiscard]] const toml::table& root() const { return root_; }
  /// "case.toml:3:1", or "--set solver.rtol=1" for an override. `key` is "table.key".
  [[nodiscard]] std::string place(const std::string& key, const toml::source_region& region) const;
  /// True when an override wrote "table.key".
  [[nodiscard]] bool is_overridden(const std::string& key) const {
    return overridden_.count(key) > 0;
  }

 private:
  void apply(const std::string& text);

  std::string name_;
  toml::table root_;
  std::map<std::string, std::string> overridden_;
};

/// One value of a case file on its way into an options struct.
struct Entry {
  std::string place;
  std::string key;
  const toml::node& node;

  /// Throws ConfigError `place: key = value: rule`.
  [[noreturn]] void refuse(std::string_view rule) const;
};

/// The value as it would stand in a case file.
[[nodiscard]] std::string value_text(const toml::node& node);

}  // namespace vesica::config
