#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "config/option_values.hpp"
#include "io/hdf5/readable_file.hpp"
#include "io/hdf5/writable_file.hpp"
#include "vesica/core/fields.hpp"

namespace vesica::io {

/// Writes one attribute for every option or result: numbers and flags as such, everything else as
/// in a case file.
class AttributeWriter {
 public:
  AttributeWriter(hdf5::WritableFile& file, std::string group, std::string prefix = "")
      : file_(file), group_(std::move(group)), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    const std::string name = fmt::format("{}{}", prefix_, field.name);
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::string>) {
      file_.set_attribute(group_, name, value);
    } else if constexpr (std::is_integral_v<T>) {
      file_.set_attribute(group_, name, static_cast<std::int64_t>(value));
    } else if constexpr (std::is_enum_v<T>) {
      file_.set_attribute(group_, name, std::string(name_of(value)));
    } else {
      file_.set_attribute(group_, name, config::toml_text(value));
    }
  }
  template <class T>
  void operator()(const Field& field, const std::optional<T>& value) {
    if (value) (*this)(field, *value);
  }

 private:
  hdf5::WritableFile& file_;
  std::string group_;
  std::string prefix_;
};

/// Reads the attributes of a result that has numbers and texts only.
class AttributeReader {
 public:
  AttributeReader(const hdf5::ReadableFile& file, std::string group)
      : file_(file), group_(std::move(group)) {}

  template <class T>
  void operator()(const Field& field, T& value) const {
    const std::string name(field.name);
    if constexpr (std::is_same_v<T, std::string>) {
      value = file_.text_attribute(group_, name);
    } else {
      value = static_cast<T>(file_.number_attribute(group_, name));
    }
  }

 private:
  const hdf5::ReadableFile& file_;
  std::string group_;
};

}  // namespace vesica::io
