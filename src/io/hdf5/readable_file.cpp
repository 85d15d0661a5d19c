#include "io/hdf5/readable_file.hpp"

#include <fmt/format.h>
#include <utility>

#include "vesica/core/error.hpp"

namespace vesica::io::hdf5 {

ReadableFile::ReadableFile(std::filesystem::path path) : path_(std::move(path)) {
  const SilentErrors silent;
  file_ = FileHandle(check(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "/", "H5Fopen"));
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
  return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
}

std::size_t ReadableFile::count(const std::string& group) const {
  const SilentErrors silent;
  H5G_info_t info{};
  (void)check(H5Gget_info_by_name(file_.get(), group.c_str(), &info, H5P_DEFAULT), group,
              "H5Gget_info_by_name");
  return info.nlinks;
}

template <class T>
std::vector<T> ReadableFile::read(const std::string& path, hid_t type) const {
  const SilentErrors silent;
  const DatasetHandle dataset(
      check(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), path, "H5Dopen"));
  const SpaceHandle space(check(H5Dget_space(dataset.get()), path, "H5Dget_space"));
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0) refuse(path, "cannot be read, H5Sget_simple_extent_npoints failed");
  std::vector<T> values(static_cast<std::size_t>(count));
  if (values.empty()) return values;
  (void)check(H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path,
              "H5Dread");
  return values;
}

std::vector<double> ReadableFile::numbers(const std::string& path) const {
  return read<double>(path, H5T_NATIVE_DOUBLE);
}

std::vector<std::int32_t> ReadableFile::integers(const std::string& path) const {
  return read<std::int32_t>(path, H5T_NATIVE_INT32);
}

AttributeHandle ReadableFile::open_attribute(const std::string& object,
                                             const std::string& name) const {
  return AttributeHandle(
      check(H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
            fmt::format("{} @{}", object, name), "H5Aopen_by_name"));
}

double ReadableFile::number_attribute(const std::string& object, const std::string& name) const {
  const SilentErrors silent;
  double value = 0;
  const AttributeHandle attribute = open_attribute(object, name);
  (void)check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value),
              fmt::format("{} @{}", object, name), "H5Aread");
  return value;
}

std::optional<double> ReadableFile::find_attribute(const std::string& object,
                                                   const std::string& name) const {
  const SilentErrors silent;
  if (H5Aexists_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT) <= 0)
    return std::nullopt;
  return number_attribute(object, name);
}

std::string ReadableFile::text_attribute(const std::string& object, const std::string& name) const {
  const SilentErrors silent;
  const std::string path = fmt::format("{} @{}", object, name);
  const AttributeHandle attribute = open_attribute(object, name);
  const TypeHandle type(check(H5Aget_type(attribute.get()), path, "H5Aget_type"));
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0)
    refuse(path, "is not a text of fixed length");
  std::string text(H5Tget_size(type.get()), '\0');
  (void)check(H5Aread(attribute.get(), type.get(), text.data()), path, "H5Aread");
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

}  // namespace vesica::io::hdf5
