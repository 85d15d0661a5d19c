#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/writable_file.hpp"

namespace vesica::io::hdf5 {

/// An HDF5 file that is read. Every call is checked; a failure is an IoError that names file,
/// object and call.
class ReadableFile {
 public:
  explicit ReadableFile(std::filesystem::path path);

  [[nodiscard]] bool has(const std::string& path) const;
  /// Number of objects in a group.
  [[nodiscard]] std::size_t count(const std::string& group) const;
  /// All values of an array, row-major.
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const;
  [[nodiscard]] std::vector<std::int32_t> integers(const std::string& path) const;
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const;
  /// Nothing when the object has no such attribute.
  [[nodiscard]] std::optional<double> find_attribute(const std::string& object,
                                                     const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& object,
                                           const std::string& name) const;
  /// Throws IoError `<file>: <object> <rule>`, for contents that make no sense.
  [[noreturn]] void refuse(const std::string& object, std::string_view rule) const;

 private:
  [[nodiscard]] hid_t check(hid_t id, const std::string& object, std::string_view call) const;
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& path, hid_t type) const;
  [[nodiscard]] AttributeHandle open_attribute(const std::string& object,
                                               const std::string& name) const;

  std::filesystem::path path_;
  FileHandle file_;
};

}  // namespace vesica::io::hdf5
