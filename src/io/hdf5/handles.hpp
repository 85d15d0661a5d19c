#pragma once

#include <hdf5.h>

#include <filesystem>
#include <memory>
#include <string>

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

/// How a file is opened: a new one in its place, an old one to be changed, an old one to be read.
enum class Access { create, change, read };

/// An HDF5 file that the driver of driver.hpp opened, with the address that keeps its first error.
/// Its journal stands beside the file: ".journal" in place of the last extension.
class DrivenFile {
 public:
  /// Throws IoError.
  DrivenFile(const std::filesystem::path& path, Access access);

  [[nodiscard]] hid_t id() const { return file_.get(); }
  /// The errno of the first failure, 0 as long as there is none.
  [[nodiscard]] int first_error() const { return *first_error_; }
  /// Returns the status of H5Fclose.
  [[nodiscard]] herr_t close() { return H5Fclose(file_.detach()); }

 private:
  std::unique_ptr<int> first_error_ = std::make_unique<int>(0);  ///< at an address that stays
  DriverHandle driver_;
  FileHandle file_;
};

/// Path of the journal of a file.
[[nodiscard]] std::filesystem::path journal_of(std::filesystem::path file);

/// What the innermost function of HDF5 says of the last failure.
[[nodiscard]] std::string cause_of_failure();

}  // namespace vesica::io::hdf5
