#include "io/hdf5/driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "io/hdf5/journal.hpp"

namespace vesica::io::hdf5 {
namespace {

/// HDF5 sees the first member and hands it back.
struct DriverFile {
  H5FD_t base{};
  int descriptor = -1;
  int* first_error = nullptr;
  std::string journal_path;
  int journal = -1;
  bool is_read_only = false;
  bool has_new_parts = false;  // since the last commit
  haddr_t end_of_allocation = 0;
  haddr_t end_of_file = 0;
  haddr_t end_of_commit = 0;  // a whole number of pages
  Pages changed;              // pages before end_of_commit, not yet in the file

  ~DriverFile() {
    if (descriptor >= 0) ::close(descriptor);
    if (journal >= 0) ::close(journal);
  }
};

DriverFile& file_of(H5FD_t* base) { return *reinterpret_cast<DriverFile*>(base); }
const DriverFile& file_of(const H5FD_t* base) { return *reinterpret_cast<const DriverFile*>(base); }

void remember(DriverFile& file, int error) {
  if (*file.first_error == 0) *file.first_error = error;
}

haddr_t whole_pages(haddr_t size) { return (size + page_size - 1) / page_size * page_size; }

/// Standard input, output and error may be closed; a file must not take their place.
int open_above_standard(const char* name, int flags) {
  const int descriptor = ::open(name, flags | O_CLOEXEC, 0666);
  if (descriptor < 0 || descriptor > STDERR_FILENO) return descriptor;
  const int higher = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(descriptor);
  return higher;
}

int open_regular(const char* name, unsigned flags) {
  if ((flags & H5F_ACC_TRUNC) != 0) {
    if (::unlink(name) != 0 && errno != ENOENT) return -1;
    return open_above_standard(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW);
  }
  const int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
  const int descriptor = open_above_standard(name, mode | O_NONBLOCK);
  struct stat status {};
  if (descriptor >= 0 && (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
    ::close(descriptor);
    errno = EINVAL;
    return -1;
  }
  return descriptor;
}

int write_changes(const DriverFile& file) {
  for (const auto& [number, bytes] : file.changed) {
    const int error = write_at(file.descriptor, number * page_size, bytes.data(), bytes.size());
    if (error != 0) return error;
  }
  return 0;
}

/// Repairs a file whose last commit was not carried out to its end.
void recover(DriverFile& file) {
  file.changed = read_journal(file.journal_path);
  if (file.is_read_only || file.changed.empty()) return;
  int error = write_changes(file);
  if (error == 0 && ::fdatasync(file.descriptor) != 0) error = errno;
  if (error != 0) remember(file, error);
  file.changed.clear();
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access_properties, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access_properties));
  if (info == nullptr) return nullptr;
  auto file = std::make_unique<DriverFile>();
  file->descriptor = open_regular(name, flags);
  if (file->descriptor < 0) {
    *info->first_error = errno;
    return nullptr;
  }
  *info->first_error = 0;  // HDF5 first looks whether the file exists
  file->first_error = info->first_error;
  file->is_read_only = (flags & H5F_ACC_RDWR) == 0;
  if (info->journal != nullptr) file->journal_path = info->journal;
  if ((flags & H5F_ACC_TRUNC) == 0) recover(*file);
  file->end_of_file = static_cast<haddr_t>(::lseek(file->descriptor, 0, SEEK_END));
  file->end_of_commit = whole_pages(file->end_of_file);
  return &file.release()->base;
}

/// See register_driver.
int carry_out(DriverFile& file) {
  if (file.has_new_parts && ::fdatasync(file.descriptor) != 0) return errno;
  if (!file.changed.empty()) {
    if (file.journal < 0)
      file.journal = open_above_standard(file.journal_path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW);
    if (file.journal < 0) return errno;
    if (const int error = write_journal(file.journal, file.changed)) return error;
    if (const int error = write_changes(file)) return error;
    file.end_of_file =
        std::max<haddr_t>(file.end_of_file, (file.changed.rbegin()->first + 1) * page_size);
  }
  if (file.end_of_allocation < file.end_of_file) {
    if (::ftruncate(file.descriptor, static_cast<off_t>(file.end_of_allocation)) != 0) return errno;
    file.end_of_file = file.end_of_allocation;
  }
  return ::fdatasync(file.descriptor) == 0 ? 0 : errno;
}

herr_t commit(H5FD_t* base, hid_t, hbool_t) {
  DriverFile& file = file_of(base);
  const bool is_changed = file.has_new_parts || !file.changed.empty();
  if (file.is_read_only || *file.first_error != 0 || !is_changed) return 0;
  if (const int error = carry_out(file)) {
    remember(file, error);
    return 0;
  }
  file.changed.clear();
  file.has_new_parts = false;
  file.end_of_commit = whole_pages(file.end_of_file);
  return 0;
}

herr_t close_file(H5FD_t* base) {
  (void)commit(base, H5P_DEFAULT, 1);
  const std::unique_ptr<DriverFile> file(&file_of(base));
  if (::close(std::exchange(file->descriptor, -1)) != 0) remember(*file, errno);
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
  if (!file.is_read_only && address > file.end_of_file && *file.first_error == 0) {
    const int error = ::posix_fallocate(file.descriptor, static_cast<off_t>(file.end_of_file),
                                        static_cast<off_t>(address - file.end_of_file));
    if (error != 0) remember(file, error);
    if (error == 0) file.end_of_file = address;
  }
  file.end_of_allocation = address;
  return 0;
}

constexpr haddr_t largest_address = static_cast<haddr_t>(1) << 62;

haddr_t end_of_file(const H5FD_t* base, H5FD_mem_t) {
  return file_of(base).is_read_only ? largest_address : file_of(base).end_of_file;
}

/// Calls `visit(page, offset in it, offset in the range, count)` for the parts of a range of bytes.
template <class Visit>
void for_each_page(haddr_t address, std::size_t size, const Visit& visit) {
  for (std::size_t done = 0; done < size;) {
    const haddr_t offset = (address + done) % page_size;
    const std::size_t count = std::min<std::size_t>(size - done, page_size - offset);
    visit((address + done) / page_size, offset, done, count);
    done += count;
  }
}

herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  void* buffer) {
  const DriverFile& file = file_of(base);
  auto* bytes = static_cast<char*>(buffer);
  if (read_at(file.descriptor, address, bytes, size) != 0) return -1;
  if (file.changed.empty()) return 0;
  for_each_page(address, size, [&](auto number, auto offset, auto done, auto count) {
    const auto page = file.changed.find(number);
    if (page != file.changed.end()) std::memcpy(bytes + done, page->second.data() + offset, count);
  });
  return 0;
}

void change_page(DriverFile& file, std::uint64_t number, std::size_t offset, const char* bytes,
                 std::size_t count) {
  const auto [page, is_new] = file.changed.try_emplace(number);
  if (is_new) {
    const int error = read_at(file.descriptor, number * page_size, page->second.data(), page_size);
    if (error != 0) remember(file, error);
  }
  std::memcpy(page->second.data() + offset, bytes, count);
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                   const void* buffer) {
  DriverFile& file = file_of(base);
  if (*file.first_error != 0) return 0;
  const auto* bytes = static_cast<const char*>(buffer);
  const std::size_t in_commit =
      address < file.end_of_commit ? std::min<haddr_t>(size, file.end_of_commit - address) : 0;
  for_each_page(address, in_commit, [&](auto number, auto offset, auto done, auto count) {
    change_page(file, number, offset, bytes + done, count);
  });
  if (in_commit == size) return 0;
  const int error =
      write_at(file.descriptor, address + in_commit, bytes + in_commit, size - in_commit);
  if (error != 0) remember(file, error);
  file.has_new_parts = true;
  file.end_of_file = std::max<haddr_t>(file.end_of_file, address + size);
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "vesica";
  driver.maxaddr = largest_address;
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
  driver.flush = commit;
  return driver;
}

}  // namespace

hid_t register_driver() {
  const H5FD_class_t driver = driver_class();
  return H5FDregister(&driver);
}

herr_t select_driver(hid_t access_properties, hid_t driver, const DriverInfo& info) {
  return H5Pset_driver(access_properties, driver, &info);
}

}  // namespace vesica::io::hdf5
