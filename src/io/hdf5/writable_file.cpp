#include "io/hdf5/writable_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "io/hdf5/driver.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io::hdf5 {
namespace {

herr_t keep_innermost(unsigned position, const H5E_error2_t* error, void* data) {
  if (position == 0 && error->desc != nullptr) *static_cast<std::string*>(data) = error->desc;
  return 0;
}

/// What the innermost function of HDF5 says of the last failure.
std::string cause_of_failure() {
  std::string cause = "no cause given";
  if (H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &cause) < 0) return "no cause given";
  return cause;
}

TypeHandle text_type(std::size_t length) {
  TypeHandle type(H5Tcopy(H5T_C_S1));
  if (type.get() < 0 || H5Tset_size(type.get(), std::max<std::size_t>(length, 1)) < 0 ||
      H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0) {
    throw IoError("HDF5 cannot make a text type");
  }
  return type;
}

}  // namespace

SilentErrors::SilentErrors() {
  if (H5Eget_auto2(H5E_DEFAULT, &function_, &data_) < 0 ||
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) < 0) {
    throw IoError("HDF5 cannot be started");
  }
}

SilentErrors::~SilentErrors() { (void)H5Eset_auto2(H5E_DEFAULT, function_, data_); }

WritableFile::WritableFile(std::filesystem::path path) : path_(std::move(path)) {
  const SilentErrors silent;
  const PropertiesHandle access(check(H5Pcreate(H5P_FILE_ACCESS), "/", "H5Pcreate"));
  driver_ = DriverHandle(check(register_driver(), "/", "H5FDregister"));
  check_status(select_driver(access.get(), driver_.get(), first_error_.get()), "/",
               "H5Pset_driver");
  file_ = FileHandle(
      check(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), "/", "H5Fcreate"));
}

hid_t WritableFile::check(hid_t id, const std::string& object, std::string_view call) const {
  if (id < 0) check_status(-1, object, call);
  return id;
}

void WritableFile::check_status(herr_t status, const std::string& object,
                                std::string_view call) const {
  if (status >= 0 && *first_error_ == 0) return;
  const std::string cause =
      *first_error_ == 0 ? cause_of_failure() : std::generic_category().message(*first_error_);
  throw IoError(
      fmt::format("{}: {} cannot be written, {}: {}", path_.string(), object, call, cause));
}

void WritableFile::make_group(const std::string& path) {
  const SilentErrors silent;
  const GroupHandle group(
      check(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), path,
            "H5Gcreate"));
}

void WritableFile::write(const std::string& path, std::span<const double> values,
                         std::size_t columns) {
  write_array(path, H5T_NATIVE_DOUBLE, values.data(), values.size(), columns);
}

void WritableFile::write(const std::string& path, std::span<const std::int32_t> values,
                         std::size_t columns) {
  write_array(path, H5T_NATIVE_INT32, values.data(), values.size(), columns);
}

void WritableFile::write_array(const std::string& path, hid_t type, const void* values,
                               std::size_t count, std::size_t columns) {
  const SilentErrors silent;
  const std::array<hsize_t, 2> shape{columns == 0 ? count : count / columns, columns};
  const SpaceHandle space(
      check(H5Screate_simple(columns == 0 ? 1 : 2, shape.data(), nullptr), path, "H5Screate"));
  const DatasetHandle dataset(check(H5Dcreate2(file_.get(), path.c_str(), type, space.get(),
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                    path, "H5Dcreate"));
  check_status(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path,
               "H5Dwrite");
}

void WritableFile::write_text(const std::string& path, const std::string& text) {
  const SilentErrors silent;
  const TypeHandle type = text_type(text.size());
  const SpaceHandle space(check(H5Screate(H5S_SCALAR), path, "H5Screate"));
  const DatasetHandle dataset(check(H5Dcreate2(file_.get(), path.c_str(), type.get(), space.get(),
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                    path, "H5Dcreate"));
  check_status(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()),
               path, "H5Dwrite");
}

void WritableFile::make_extendable(const std::string& path) {
  constexpr hsize_t rows_at_once = 128;
  const hsize_t none = 0;
  const hsize_t unlimited = H5S_UNLIMITED;
  const SpaceHandle space(check(H5Screate_simple(1, &none, &unlimited), path, "H5Screate"));
  const PropertiesHandle properties(check(H5Pcreate(H5P_DATASET_CREATE), path, "H5Pcreate"));
  check_status(H5Pset_chunk(properties.get(), 1, &rows_at_once), path, "H5Pset_chunk");
  const DatasetHandle dataset(
      check(H5Dcreate2(file_.get(), path.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                       properties.get(), H5P_DEFAULT),
            path, "H5Dcreate"));
}

void WritableFile::append(const std::string& path, std::span<const double> values) {
  const SilentErrors silent;
  const htri_t exists = H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT);
  check_status(exists, path, "H5Lexists");
  if (exists == 0) make_extendable(path);
  const DatasetHandle dataset(
      check(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), path, "H5Dopen"));
  hsize_t length = 0;
  {
    const SpaceHandle space(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
    check_status(H5Sget_simple_extent_dims(space.get(), &length, nullptr), path,
                 "H5Sget_simple_extent_dims");
  }
  const hsize_t count = values.size();
  const hsize_t extended = length + count;
  check_status(H5Dset_extent(dataset.get(), &extended), path, "H5Dset_extent");
  const SpaceHandle in_file(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
  check_status(
      H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, &length, nullptr, &count, nullptr), path,
      "H5Sselect_hyperslab");
  const SpaceHandle in_memory(check(H5Screate_simple(1, &count, nullptr), path, "H5Screate"));
  check_status(H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, in_memory.get(), in_file.get(),
                        H5P_DEFAULT, values.data()),
               path, "H5Dwrite");
}

void WritableFile::link(const std::string& path, const std::string& target) {
  const SilentErrors silent;
  check_status(H5Lcreate_soft(target.c_str(), file_.get(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
               path, "H5Lcreate_soft");
}

void WritableFile::set_attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void WritableFile::set_attribute(const std::string& object, const std::string& name,
                                 std::int64_t value) {
  write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void WritableFile::set_attribute(const std::string& object, const std::string& name,
                                 const std::string& value) {
  const SilentErrors silent;
  const TypeHandle type = text_type(value.size());
  write_attribute(object, name, type.get(), value.c_str());
}

void WritableFile::write_attribute(const std::string& object, const std::string& name, hid_t type,
                                   const void* value) {
  const SilentErrors silent;
  const std::string path = fmt::format("{} @{}", object, name);
  const ObjectHandle owner(
      check(H5Oopen(file_.get(), object.c_str(), H5P_DEFAULT), path, "H5Oopen"));
  const SpaceHandle space(check(H5Screate(H5S_SCALAR), path, "H5Screate"));
  const AttributeHandle attribute(
      check(H5Acreate2(owner.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
            path, "H5Acreate"));
  check_status(H5Awrite(attribute.get(), type, value), path, "H5Awrite");
}

void WritableFile::flush() {
  const SilentErrors silent;
  check_status(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "/", "H5Fflush");
}

void WritableFile::close() {
  const SilentErrors silent;
  check_status(H5Fclose(file_.detach()), "/", "H5Fclose");
}

}  // namespace vesica::io::hdf5
