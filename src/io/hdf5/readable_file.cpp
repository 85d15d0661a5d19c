#include "io/hdf5/readable_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>
#include <type_traits>
#include <utility>

#include "vesica/core/error.hpp"

namespace vesica::io::hdf5 {
namespace {

constexpr std::uint64_t largest_compression = 1024;  // of deflate

/// HDF5 asks before it opens the file that an external link names.
herr_t stay_in_the_file(const char*, const char*, const char*, const char*, unsigned*, hid_t,
                        void*) {
  return -1;
}

PropertiesHandle links_in_the_file() {
  PropertiesHandle properties(H5Pcreate(H5P_LINK_ACCESS));
  if (H5Pset_elink_cb(properties.get(), stay_in_the_file, nullptr) < 0)
    throw IoError("HDF5 cannot be started");
  return properties;
}

bool is_compressed(const PropertiesHandle& creation) {
  for (int i = 0; i < H5Pget_nfilters(creation.get()); ++i) {
    unsigned flags = 0;
    std::size_t num_values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(creation.get(), static_cast<unsigned>(i), &flags,
                                               &num_values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_FLETCHER32) return true;
  }
  return false;
}

std::string attribute_path(const std::string& object, const std::string& name) {
  return fmt::format("{} @{}", object, name);
}

}  // namespace

ReadableFile::ReadableFile(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, Access::read), links_(links_in_the_file()) {
  std::error_code ignored;
  file_size_ = std::filesystem::file_size(path_, ignored);
}

hid_t ReadableFile::check(hid_t id, const std::string& object, std::string_view call) const {
  if (id < 0) refuse(object, fmt::format("cannot be read, {} failed", call));
  return id;
}

void ReadableFile::refuse(const std::string& object, std::string_view rule) const {
  throw IoError(fmt::format("{}: {} {}", path_.string(), object, rule));
}

bool ReadableFile::has(const std::string& path) const {
  const SilentErrors silent;
  return H5Lexists(file_.id(), path.c_str(), links_.get()) > 0;
}

std::size_t ReadableFile::count(const std::string& group) const {
  const SilentErrors silent;
  H5G_info_t info{};
  (void)check(H5Gget_info_by_name(file_.id(), group.c_str(), &info, links_.get()), group,
              "H5Gget_info_by_name");
  return info.nlinks;
}

std::vector<std::string> ReadableFile::names(const std::string& group) const {
  const SilentErrors silent;
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  (void)check(H5Literate_by_name(file_.id(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
                                 add, &names, links_.get()),
              group, "H5Literate_by_name");
  return names;
}

DatasetHandle ReadableFile::open(const std::string& path) const {
  const ObjectHandle object(
      check(H5Oopen(file_.id(), path.c_str(), links_.get()), path, "H5Oopen"));
  if (H5Iget_type(object.get()) != H5I_DATASET) refuse(path, "must be an array");
  DatasetHandle dataset(check(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), path, "H5Dopen"));
  check_storage(dataset, path);
  return dataset;
}

/// The values stand in the file, and it has bytes for them.
void ReadableFile::check_storage(const DatasetHandle& dataset, const std::string& path) const {
  const PropertiesHandle creation(
      check(H5Dget_create_plist(dataset.get()), path, "H5Dget_create_plist"));
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  const bool is_inside = layout == H5D_COMPACT || layout == H5D_CHUNKED || layout == H5D_CONTIGUOUS;
  if (!is_inside || H5Pget_external_count(creation.get()) != 0)
    refuse(path, "must not have its values in another file");
  const TypeHandle type(check(H5Dget_type(dataset.get()), path, "H5Dget_type"));
  const SpaceHandle space(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  const std::uint64_t limit = file_size_ * (is_compressed(creation) ? largest_compression : 1);
  const std::uint64_t size = std::max<std::size_t>(H5Tget_size(type.get()), 1);
  if (count < 0 || static_cast<std::uint64_t>(count) > limit / size)
    refuse(path, "claims more values than the file has bytes for");
}

std::size_t ReadableFile::rows_of(const DatasetHandle& dataset, const std::string& path,
                                  std::size_t columns) const {
  const SpaceHandle space(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
  std::array<hsize_t, 2> shape{};
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank != (columns == 0 ? 1 : 2))
    refuse(path, fmt::format("must have {} dimensions, not {}", columns == 0 ? 1 : 2, rank));
  (void)check(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), path,
              "H5Sget_simple_extent_dims");
  if (columns != 0 && shape[1] != columns)
    refuse(path, fmt::format("must have {} columns, not {}", columns, shape[1]));
  return shape[0];
}

std::size_t ReadableFile::rows(const std::string& path, std::size_t columns) const {
  const SilentErrors silent;
  return rows_of(open(path), path, columns);
}

template <class T>
std::vector<T> ReadableFile::read(const std::string& path, std::size_t rows, std::size_t columns,
                                  hid_t type) const {
  const SilentErrors silent;
  const DatasetHandle dataset = open(path);
  const std::size_t found = rows_of(dataset, path, columns);
  if (found != rows) refuse(path, fmt::format("must have {} rows, not {}", rows, found));
  const TypeHandle stored(check(H5Dget_type(dataset.get()), path, "H5Dget_type"));
  if (H5Tget_class(stored.get()) != H5Tget_class(type) ||
      H5Tget_size(stored.get()) > sizeof(double))
    refuse(path, std::is_integral_v<T> ? "must hold whole numbers" : "must hold numbers");
  std::vector<T> values(rows * std::max<std::size_t>(columns, 1));
  if (values.empty()) return values;
  (void)check(H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path,
              "H5Dread");
  return values;
}

std::vector<double> ReadableFile::numbers_or_nan(const std::string& path, std::size_t rows) const {
  return read<double>(path, rows, 0, H5T_NATIVE_DOUBLE);
}

std::vector<double> ReadableFile::numbers(const std::string& path, std::size_t rows,
                                          std::size_t columns) const {
  std::vector<double> values = read<double>(path, rows, columns, H5T_NATIVE_DOUBLE);
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    refuse(path, "must hold finite numbers only");
  return values;
}

std::vector<std::int32_t> ReadableFile::integers(const std::string& path, std::size_t rows,
                                                 std::size_t columns) const {
  return read<std::int32_t>(path, rows, columns, H5T_NATIVE_INT32);
}

std::string ReadableFile::text(const std::string& path) const {
  const SilentErrors silent;
  const DatasetHandle dataset = open(path);
  const TypeHandle type(check(H5Dget_type(dataset.get()), path, "H5Dget_type"));
  const SpaceHandle space(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    refuse(path, "must be one text of fixed length");
  std::string text(H5Tget_size(type.get()), '\0');
  (void)check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), path,
              "H5Dread");
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

AttributeHandle ReadableFile::open_attribute(const std::string& object,
                                             const std::string& name) const {
  const std::string path = attribute_path(object, name);
  AttributeHandle attribute(
      check(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, links_.get()),
            path, "H5Aopen_by_name"));
  const SpaceHandle space(check(H5Aget_space(attribute.get()), path, "H5Aget_space"));
  if (H5Sget_simple_extent_npoints(space.get()) != 1) refuse(path, "must be one value");
  return attribute;
}

double ReadableFile::number_attribute(const std::string& object, const std::string& name) const {
  const SilentErrors silent;
  const std::string path = attribute_path(object, name);
  const AttributeHandle attribute = open_attribute(object, name);
  const TypeHandle type(check(H5Aget_type(attribute.get()), path, "H5Aget_type"));
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) refuse(path, "must be a number");
  double value = 0;
  (void)check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value), path, "H5Aread");
  if (!std::isfinite(value)) refuse(path, "must be finite");
  return value;
}

bool ReadableFile::has_attribute(const std::string& object, const std::string& name) const {
  const SilentErrors silent;
  const htri_t exists = H5Aexists_by_name(file_.id(), object.c_str(), name.c_str(), links_.get());
  return check(exists, attribute_path(object, name), "H5Aexists_by_name") > 0;
}

std::optional<double> ReadableFile::find_attribute(const std::string& object,
                                                   const std::string& name) const {
  if (!has_attribute(object, name)) return std::nullopt;
  return number_attribute(object, name);
}

std::string ReadableFile::text_attribute(const std::string& object, const std::string& name) const {
  const SilentErrors silent;
  const std::string path = attribute_path(object, name);
  const AttributeHandle attribute = open_attribute(object, name);
  const TypeHandle type(check(H5Aget_type(attribute.get()), path, "H5Aget_type"));
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0)
    refuse(path, "is not a text of fixed length");
  if (H5Tget_size(type.get()) > file_size_) refuse(path, "claims more bytes than the file has");
  std::string text(H5Tget_size(type.get()), '\0');
  (void)check(H5Aread(attribute.get(), type.get(), text.data()), path, "H5Aread");
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

}  // namespace vesica::io::hdf5
