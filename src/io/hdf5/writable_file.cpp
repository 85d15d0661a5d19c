#include "io/hdf5/writable_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "vesica/core/error.hpp"

namespace vesica::io::hdf5 {
namespace {

TypeHandle text_type(std::size_t length) {
  TypeHandle type(H5Tcopy(H5T_C_S1));
  if (type.get() < 0 || H5Tset_size(type.get(), std::max<std::size_t>(length, 1)) < 0 ||
      H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0) {
    throw IoError("HDF5 cannot make a text type");
  }
  return type;
}

/// (rows, columns); (rows) for columns = 0.
std::vector<hsize_t> shape_of(std::size_t count, std::size_t columns) {
  if (columns == 0) return {count};
  return {count / columns, columns};
}

}  // namespace

WritableFile::WritableFile(std::filesystem::path path, Access access)
    : path_(std::move(path)), file_(path_, access) {}

hid_t WritableFile::check(hid_t id, const std::string& object, std::string_view call) const {
  if (id < 0) check_status(-1, object, call);
  return id;
}

void WritableFile::check_status(herr_t status, const std::string& object,
                                std::string_view call) const {
  if (status >= 0 && file_.first_error() == 0) return;
  const std::string cause = file_.first_error() == 0
                                ? cause_of_failure()
                                : std::generic_category().message(file_.first_error());
  throw IoError(
      fmt::format("{}: {} cannot be written, {}: {}", path_.string(), object, call, cause));
}

void WritableFile::make_group(const std::string& path) {
  const SilentErrors silent;
  const GroupHandle group(
      check(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), path,
            "H5Gcreate"));
}

bool WritableFile::has(const std::string& path) const {
  const SilentErrors silent;
  return H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT) > 0;
}

void WritableFile::remove(const std::string& path) {
  const SilentErrors silent;
  check_status(H5Ldelete(file_.id(), path.c_str(), H5P_DEFAULT), path, "H5Ldelete");
}

void WritableFile::write(const std::string& path, std::span<const double> values,
                         std::size_t columns) {
  write_array(path, H5T_NATIVE_DOUBLE, values.data(), shape_of(values.size(), columns));
}

void WritableFile::write(const std::string& path, std::span<const std::int32_t> values,
                         std::size_t columns) {
  write_array(path, H5T_NATIVE_INT32, values.data(), shape_of(values.size(), columns));
}

/// One chunk with a checksum; without it a reader finds the fill value.
PropertiesHandle WritableFile::creation(const std::string& path, hid_t type,
                                        std::span<const hsize_t> chunk) const {
  PropertiesHandle properties(check(H5Pcreate(H5P_DATASET_CREATE), path, "H5Pcreate"));
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  const std::int32_t no_node = -1;
  const H5T_class_t kind = H5Tget_class(type);
  herr_t status = H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  if (status >= 0) status = H5Pset_fletcher32(properties.get());
  if (status >= 0) status = H5Pset_obj_track_times(properties.get(), false);
  if (status >= 0 && kind == H5T_FLOAT)
    status = H5Pset_fill_value(properties.get(), type, &no_number);
  if (status >= 0 && kind == H5T_INTEGER)
    status = H5Pset_fill_value(properties.get(), type, &no_node);
  check_status(status, path, "H5Pset");
  return properties;
}

void WritableFile::write_array(const std::string& path, hid_t type, const void* values,
                               std::span<const hsize_t> shape) {
  const SilentErrors silent;
  const SpaceHandle space(check(
      H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), path, "H5Screate"));
  const PropertiesHandle properties = creation(path, type, shape);
  const DatasetHandle dataset(check(H5Dcreate2(file_.id(), path.c_str(), type, space.get(),
                                               H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                                    path, "H5Dcreate"));
  check_status(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path,
               "H5Dwrite");
}

void WritableFile::write_text(const std::string& path, const std::string& text) {
  const TypeHandle type = text_type(text.size());
  const hsize_t one = 1;
  write_array(path, type.get(), text.c_str(), {&one, 1});
}

void WritableFile::make_extendable(const std::string& path) {
  constexpr hsize_t rows_at_once = 128;
  const hsize_t none = 0;
  const hsize_t unlimited = H5S_UNLIMITED;
  const SpaceHandle space(check(H5Screate_simple(1, &none, &unlimited), path, "H5Screate"));
  const PropertiesHandle properties = creation(path, H5T_NATIVE_DOUBLE, {&rows_at_once, 1});
  const DatasetHandle dataset(
      check(H5Dcreate2(file_.id(), path.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                       properties.get(), H5P_DEFAULT),
            path, "H5Dcreate"));
}

void WritableFile::append(const std::string& path, std::span<const double> values) {
  const SilentErrors silent;
  const htri_t exists = H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT);
  check_status(exists, path, "H5Lexists");
  if (exists == 0) make_extendable(path);
  const DatasetHandle dataset(
      check(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), path, "H5Dopen"));
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

void WritableFile::shorten(const std::string& path, std::size_t rows) {
  const SilentErrors silent;
  const DatasetHandle dataset(
      check(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), path, "H5Dopen"));
  const hsize_t extent = rows;
  check_status(H5Dset_extent(dataset.get(), &extent), path, "H5Dset_extent");
}

void WritableFile::link(const std::string& path, const std::string& target) {
  const SilentErrors silent;
  check_status(H5Lcreate_soft(target.c_str(), file_.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
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
      check(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), path, "H5Oopen"));
  const htri_t exists = H5Aexists(owner.get(), name.c_str());
  check_status(exists, path, "H5Aexists");
  if (exists > 0) check_status(H5Adelete(owner.get(), name.c_str()), path, "H5Adelete");
  const SpaceHandle space(check(H5Screate(H5S_SCALAR), path, "H5Screate"));
  const AttributeHandle attribute(
      check(H5Acreate2(owner.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
            path, "H5Acreate"));
  check_status(H5Awrite(attribute.get(), type, value), path, "H5Awrite");
}

void WritableFile::flush() {
  const SilentErrors silent;
  check_status(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "/", "H5Fflush");
}

void WritableFile::close() {
  const SilentErrors silent;
  check_status(file_.close(), "/", "H5Fclose");
}

}  // namespace vesica::io::hdf5
