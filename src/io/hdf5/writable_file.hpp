#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vesica/core/handle.hpp"

namespace vesica::io::hdf5 {

inline void close_group(hid_t id) { (void)H5Gclose(id); }
inline void close_space(hid_t id) { (void)H5Sclose(id); }
inline void close_dataset(hid_t id) { (void)H5Dclose(id); }
inline void close_attribute(hid_t id) { (void)H5Aclose(id); }
inline void close_type(hid_t id) { (void)H5Tclose(id); }
inline void close_properties(hid_t id) { (void)H5Pclose(id); }
inline void close_object(hid_t id) { (void)H5Oclose(id); }
inline void close_file(hid_t id) { (void)H5Fclose(id); }
inline void release_driver(hid_t id) { (void)H5FDunregister(id); }

using GroupHandle = Handle<hid_t, close_group>;
using SpaceHandle = Handle<hid_t, close_space>;
using DatasetHandle = Handle<hid_t, close_dataset>;
using AttributeHandle = Handle<hid_t, close_attribute>;
using TypeHandle = Handle<hid_t, close_type>;
using PropertiesHandle = Handle<hid_t, close_properties>;
using ObjectHandle = Handle<hid_t, close_object>;
using FileHandle = Handle<hid_t, close_file>;
using DriverHandle = Handle<hid_t, release_driver>;

/// Keeps HDF5 from printing its error stack while it lives; the errors come as exceptions.
class SilentErrors {
 public:
  SilentErrors();
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;
  ~SilentErrors();

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// An HDF5 file that is written. Every call is checked; a failure is an IoError that names file,
/// object, call and the cause that HDF5 gives. Objects are named by their full path,
/// "/frames/000000/positions".
class WritableFile {
 public:
  /// Makes the file, in place of an old one, with the driver of hdf5_driver.hpp.
  explicit WritableFile(std::filesystem::path path);

  void make_group(const std::string& path);
  /// Row-major array of `values`, shape (rows, columns); one-dimensional for columns = 0.
  void write(const std::string& path, std::span<const double> values, std::size_t columns = 0);
  void write(const std::string& path, std::span<const std::int32_t> values,
             std::size_t columns = 0);
  void write_text(const std::string& path, const std::string& text);
  /// Adds rows to a one-dimensional array, which is made when it does not exist.
  void append(const std::string& path, std::span<const double> values);
  void link(const std::string& path, const std::string& target);
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  void flush();
  /// Closes the file; nothing can be written any more.
  void close();

 private:
  /// Returns a valid id in every case, so that its handle can release it; the driver's error is
  /// left to `check_status`, which every write ends with.
  [[nodiscard]] hid_t check(hid_t id, const std::string& object, std::string_view call) const;
  /// Also throws when the driver has met an error that HDF5 does not know of.
  void check_status(herr_t status, const std::string& object, std::string_view call) const;
  void write_array(const std::string& path, hid_t type, const void* values, std::size_t count,
                   std::size_t columns);
  void make_extendable(const std::string& path);
  void write_attribute(const std::string& object, const std::string& name, hid_t type,
                       const void* value);

  std::filesystem::path path_;
  std::unique_ptr<int> first_error_ =
      std::make_unique<int>(0);  ///< errno, at an address that stays
  DriverHandle driver_;
  FileHandle file_;
};

}  // namespace vesica::io::hdf5
