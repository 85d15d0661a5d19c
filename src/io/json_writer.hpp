#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vesica::io {

/// Writes one JSON object, two spaces an indentation level. Numbers are the shortest text that
/// reads back as the same double; NaN, infinities and absent values become null.
class JsonWriter {
 public:
  JsonWriter() = default;

  void begin_object(std::string_view key);
  void end_object();
  /// An array of objects; each one is written between begin_element() and end_object().
  void begin_array(std::string_view key);
  void begin_element();
  void end_array();
  void add(std::string_view key, double value);
  void add(std::string_view key, std::optional<double> value);
  void add(std::string_view key, long value);
  void add(std::string_view key, int value) { add(key, static_cast<long>(value)); }
  void add(std::string_view key, std::optional<int> value);
  void add(std::string_view key, std::string_view value);
  void add(std::string_view key, std::optional<bool> value);
  /// An array on one line.
  void add(std::string_view key, const std::vector<double>& values);
  /// The whole object; every begun object must have ended.
  [[nodiscard]] std::string text() const { return "{" + body_ + "\n}\n"; }

 private:
  void add_raw(std::string_view key, std::string_view value);

  std::string body_;
  int depth_ = 1;
  bool needs_comma_ = false;
};

}  // namespace vesica::io
