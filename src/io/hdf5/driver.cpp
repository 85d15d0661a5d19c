#include "io/hdf5/driver.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace vesica::io::hdf5 {
namespace {

struct DriverInfo {
  int* first_error = nullptr;
};

/// HDF5 sees the first member and hands it back.
struct DriverFile {
  H5FD_t base{};
  int descriptor = -1;
  int* first_error = nullptr;
  haddr_t end_of_allocation = 0;
  haddr_t end_of_file = 0;
};

DriverFile& file_of(H5FD_t* base) { return *reinterpret_cast<DriverFile*>(base); }
const DriverFile& file_of(const H5FD_t* base) { return *reinterpret_cast<const DriverFile*>(base); }

void remember(DriverFile& file, int error) {
  if (*file.first_error == 0) *file.first_error = error;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access_properties, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access_properties));
  if (info == nullptr) return nullptr;
  const bool is_new = (flags & H5F_ACC_TRUNC) != 0;
  const int descriptor = ::open(name, O_RDWR | O_CLOEXEC | (is_new ? O_CREAT | O_TRUNC : 0), 0666);
  if (descriptor < 0) {
    *info->first_error = errno;
    return nullptr;
  }
  *info->first_error = 0;  // HDF5 first looks whether the file exists
  auto file = std::make_unique<DriverFile>();
  file->descriptor = descriptor;
  file->first_error = info->first_error;
  file->end_of_file = static_cast<haddr_t>(::lseek(descriptor, 0, SEEK_END));
  return &file.release()->base;
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<DriverFile> file(&file_of(base));
  if (::close(file->descriptor) != 0) remember(*file, errno);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const int first = file_of(a).descriptor;
  const int second = file_of(b).descriptor;
  return first < second ? -1 : static_cast<int>(first > second);
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA |
           H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocation(const H5FD_t* base, H5FD_mem_t) {
  return file_of(base).end_of_allocation;
}

herr_t set_end_of_allocation(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  DriverFile& file = file_of(base);
  if (address > file.end_of_file && *file.first_error == 0) {
    const int error = ::posix_fallocate(file.descriptor, static_cast<off_t>(file.end_of_file),
                                        static_cast<off_t>(address - file.end_of_file));
    if (error != 0) remember(file, error);
    if (error == 0) file.end_of_file = address;
  }
  file.end_of_allocation = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* base, H5FD_mem_t) { return file_of(base).end_of_file; }

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  void* buffer) {
  auto* bytes = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count =
        ::pread(file_of(base).descriptor, bytes, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) {  // HDF5 expects zeros beyond the end
      std::memset(bytes, 0, size);
      return 0;
    }
    bytes += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  return 0;
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                   const void* buffer) {
  DriverFile& file = file_of(base);
  const auto* bytes = static_cast<const char*>(buffer);
  while (size > 0 && *file.first_error == 0) {
    const ssize_t count = ::pwrite(file.descriptor, bytes, size, static_cast<off_t>(address));
    if (count < 0) {
      if (errno != EINTR) remember(file, errno);
      continue;
    }
    bytes += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  file.end_of_file = std::max(file.end_of_file, address);
  return 0;
}

herr_t truncate_file(H5FD_t* base, hid_t, hbool_t) {
  DriverFile& file = file_of(base);
  if (*file.first_error != 0 || file.end_of_file == file.end_of_allocation) return 0;
  if (::ftruncate(file.descriptor, static_cast<off_t>(file.end_of_allocation)) != 0)
    remember(file, errno);
  file.end_of_file = file.end_of_allocation;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "vesica";
  driver.maxaddr = static_cast<haddr_t>(1) << 62;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = end_of_allocation;
  driver.set_eoa = set_end_of_allocation;
  driver.get_eof = end_of_file;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = truncate_file;
  return driver;
}

}  // namespace

hid_t register_driver() {
  const H5FD_class_t driver = driver_class();
  return H5FDregister(&driver);
}

herr_t select_driver(hid_t access_properties, hid_t driver, int* first_error) {
  const DriverInfo info{first_error};
  return H5Pset_driver(access_properties, driver, &info);
}

}  // namespace vesica::io::hdf5
