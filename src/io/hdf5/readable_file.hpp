#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/handles.hpp"

namespace vesica::io::hdf5 {

/// An HDF5 file that is read and not trusted. Links out of it are not followed. Every object has to
/// have the type and shape that is asked for, and not more values than the file has bytes for,
/// before memory is taken; every number has to be finite. Every call is checked; a failure is an
/// IoError that names file, object and rule or call.
class ReadableFile {
 public:
  explicit ReadableFile(std::filesystem::path path);

  [[nodiscard]] bool has(const std::string& path) const;
  /// Number of objects in a group.
  [[nodiscard]] std::size_t count(const std::string& group) const;
  /// Names of the objects in a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
  /// Number of rows of an array with so many columns; 0 for a one-dimensional one.
  [[nodiscard]] std::size_t rows(const std::string& path, std::size_t columns = 0) const;
  /// All values of an array of shape (rows, columns), or (rows) for columns = 0, row-major.
  [[nodiscard]] std::vector<double> numbers(const std::string& path, std::size_t rows,
                                            std::size_t columns = 0) const;
  /// The same of one dimension; NaN is allowed.
  [[nodiscard]] std::vector<double> numbers_or_nan(const std::string& path, std::size_t rows) const;
  [[nodiscard]] std::vector<std::int32_t> integers(const std::string& path, std::size_t rows,
                                                   std::size_t columns = 0) const;
  /// A text that WritableFile::write_text wrote.
  [[nodiscard]] std::string text(const std::string& path) const;
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const;
  /// Nothing when the object has no such attribute.
  [[nodiscard]] std::optional<double> find_attribute(const std::string& object,
                                                     const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& object,
                                           const std::string& name) const;
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// Throws IoError `<file>: <object> <rule>`, for contents that make no sense.
  [[noreturn]] void refuse(const std::string& object, std::string_view rule) const;

 private:
  [[nodiscard]] hid_t check(hid_t id, const std::string& object, std::string_view call) const;
  [[nodiscard]] DatasetHandle open(const std::string& path) const;
  void check_storage(const DatasetHandle& dataset, const std::string& path) const;
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& path, std::size_t rows, std::size_t columns,
                                    hid_t type) const;
  [[nodiscard]] std::size_t rows_of(const DatasetHandle& dataset, const std::string& path,
                                    std::size_t columns) const;
  [[nodiscard]] AttributeHandle open_attribute(const std::string& object,
                                               const std::string& name) const;

  std::filesystem::path path_;
  DrivenFile file_;
  PropertiesHandle links_;  ///< refuse to lead out of the file
  std::uint64_t file_size_ = 0;
};

}  // namespace vesica::io::hdf5
