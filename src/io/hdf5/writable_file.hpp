#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "io/hdf5/handles.hpp"

namespace vesica::io::hdf5 {

/// An HDF5 file that is written. Every call is checked; a failure is an IoError that names file,
/// object, call and the cause that HDF5 gives. Objects are named by their full path,
/// "/frames/000000/positions". Arrays and texts have the checksum fletcher32; values that were lost
/// read as NaN or -1.
class WritableFile {
 public:
  /// Makes the file in place of an old one, or opens it to be changed.
  explicit WritableFile(std::filesystem::path path, Access access = Access::create);

  /// Notes the name that the open file has now, for messages.
  void was_renamed(std::filesystem::path path) { path_ = std::move(path); }
  void make_group(const std::string& path);
  [[nodiscard]] bool has(const std::string& path) const;
  /// Removes an object with what is in it.
  void remove(const std::string& path);
  /// Row-major array of `values`, shape (rows, columns); one-dimensional for columns = 0.
  void write(const std::string& path, std::span<const double> values, std::size_t columns = 0);
  void write(const std::string& path, std::span<const std::int32_t> values,
             std::size_t columns = 0);
  void write_text(const std::string& path, const std::string& text);
  /// Adds rows to a one-dimensional array, which is made when it does not exist.
  void append(const std::string& path, std::span<const double> values);
  /// Keeps the first `rows` of an array that `append` made.
  void shorten(const std::string& path, std::size_t rows);
  void link(const std::string& path, const std::string& target);
  /// Takes the place of an attribute of that name.
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  /// Commits everything: a kill, or a loss of power, leaves the file as it is now.
  void flush();
  /// Closes the file; nothing can be written any more.
  void close();

 private:
  /// Returns a valid id in every case, so that its handle can release it; the driver's error is
  /// left to `check_status`, which every write ends with.
  [[nodiscard]] hid_t check(hid_t id, const std::string& object, std::string_view call) const;
  /// Also throws when the driver has met an error that HDF5 does not know of.
  void check_status(herr_t status, const std::string& object, std::string_view call) const;
  void write_array(const std::string& path, hid_t type, const void* values,
                   std::span<const hsize_t> shape);
  [[nodiscard]] PropertiesHandle creation(const std::string& path, hid_t type,
                                          std::span<const hsize_t> chunk) const;
  void make_extendable(const std::string& path);
  void write_attribute(const std::string& object, const std::string& name, hid_t type,
                       const void* value);

  std::filesystem::path path_;
  DrivenFile file_;
};

}  // namespace vesica::io::hdf5
