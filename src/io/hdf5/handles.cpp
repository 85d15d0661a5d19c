#include "io/hdf5/handles.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "io/hdf5/driver.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io::hdf5 {
namespace {

/// Half of the places in a node of the index of chunks. Most arrays have one chunk; with the usual
/// 32 an index takes 2 to 3 kB.
constexpr unsigned entries_of_an_index = 4;

herr_t keep_innermost(unsigned position, const H5E_error2_t* error, void* data) {
  if (position == 0 && error->desc != nullptr) *static_cast<std::string*>(data) = error->desc;
  return 0;
}

/// The format of HDF5 1.8: its metadata carry checksums, those of the older one do not.
herr_t select_format(hid_t access_properties) {
  return H5Pset_libver_bounds(access_properties, H5F_LIBVER_V18, H5F_LIBVER_V18);
}

}  // namespace

SilentErrors::SilentErrors() {
  if (H5Eget_auto2(H5E_DEFAULT, &function_, &data_) < 0 ||
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) < 0) {
    throw IoError("HDF5 cannot be started");
  }
}

SilentErrors::~SilentErrors() { (void)H5Eset_auto2(H5E_DEFAULT, function_, data_); }

std::string cause_of_failure() {
  std::string cause = "no cause given";
  if (H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &cause) < 0) return "no cause given";
  return cause;
}

std::filesystem::path journal_of(std::filesystem::path file) {
  return file.replace_extension(".journal");
}

DrivenFile::DrivenFile(const std::filesystem::path& path, Access access) {
  const SilentErrors silent;
  const auto fail = [&](std::string_view call) {
    const std::string cause =
        first_error() == 0 ? cause_of_failure() : std::generic_category().message(first_error());
    throw IoError(fmt::format("{}: / cannot be {}, {} failed: {}", path.string(),
                              access == Access::read ? "read" : "written", call, cause));
  };
  const PropertiesHandle properties(H5Pcreate(H5P_FILE_ACCESS));
  driver_ = DriverHandle(register_driver());
  const std::string journal = journal_of(path).string();
  if (select_driver(properties.get(), driver_.get(), {first_error_.get(), journal.c_str()}) < 0)
    fail("H5Pset_driver");
  if (access != Access::read && select_format(properties.get()) < 0) fail("H5Pset_libver_bounds");
  hid_t file = -1;
  if (access == Access::create) {
    const PropertiesHandle creation(H5Pcreate(H5P_FILE_CREATE));
    if (H5Pset_istore_k(creation.get(), entries_of_an_index) < 0) fail("H5Pset_istore_k");
    file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), properties.get());
  } else {
    file = H5Fopen(path.c_str(), access == Access::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR,
                   properties.get());
  }
  if (file < 0) fail(access == Access::create ? "H5Fcreate" : "H5Fopen");
  file_ = FileHandle(file);
}

}  // namespace vesica::io::hdf5
