#include "io/json_writer.hpp"

#include <fmt/format.h>
#include <cmath>

namespace vesica::io {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      out += '\\';
      out += character;
    } else if (static_cast<unsigned char>(character) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(character));
    } else {
      out += character;
    }
  }
  return out + '"';
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

}  // namespace

void JsonWriter::add_raw(std::string_view key, std::string_view value) {
  body_ +=
      fmt::format("{}\n{:{}}{}: {}", needs_comma_ ? "," : "", "", 2 * depth_, quoted(key), value);
  needs_comma_ = true;
}

void JsonWriter::begin_object(std::string_view key) {
  add_raw(key, "{");
  needs_comma_ = false;
  ++depth_;
}

void JsonWriter::end_object() {
  --depth_;
  body_ += fmt::format("\n{:{}}}}", "", 2 * depth_);
  needs_comma_ = true;
}

void JsonWriter::begin_array(std::string_view key) {
  add_raw(key, "[");
  needs_comma_ = false;
  ++depth_;
}

void JsonWriter::begin_element() {
  body_ += fmt::format("{}\n{:{}}{{", needs_comma_ ? "," : "", "", 2 * depth_);
  needs_comma_ = false;
  ++depth_;
}

void JsonWriter::end_array() {
  --depth_;
  body_ += needs_comma_ ? fmt::format("\n{:{}}]", "", 2 * depth_) : "]";
  needs_comma_ = true;
}

void JsonWriter::add(std::string_view key, double value) { add_raw(key, number_text(value)); }

void JsonWriter::add(std::string_view key, const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", number_text(value));
  add_raw(key, fmt::format("[{}]", text));
}

void JsonWriter::add(std::string_view key, std::optional<double> value) {
  value ? add(key, *value) : add_raw(key, "null");
}

void JsonWriter::add(std::string_view key, long value) { add_raw(key, fmt::format("{}", value)); }

void JsonWriter::add(std::string_view key, std::optional<int> value) {
  value ? add(key, *value) : add_raw(key, "null");
}

void JsonWriter::add(std::string_view key, std::optional<bool> value) {
  add_raw(key, !value ? "null" : *value ? "true" : "false");
}

void JsonWriter::add(std::string_view key, std::string_view value) { add_raw(key, quoted(value)); }

}  // namespace vesica::io
