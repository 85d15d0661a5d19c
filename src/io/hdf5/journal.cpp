#include "io/hdf5/journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

namespace vesica::io::hdf5 {
namespace {

struct Header {
  std::array<char, 16> name{'v', 'e', 's', 'i', 'c', 'a', ' ', 'j', 'o', 'u', 'r', 'n', 'a', 'l'};
  std::uint64_t num_pages = 0;
  std::uint64_t checksum = 0;  ///< of everything behind the header
};

struct Record {
  std::uint64_t number = 0;
  std::array<char, page_size> bytes{};
};

/// FNV-1a.
std::uint64_t checksum_of(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325U;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return sum;
}

std::string_view bytes_of(const std::vector<Record>& records) {
  return {reinterpret_cast<const char*>(records.data()), records.size() * sizeof(Record)};
}

bool is_whole(const Header& header, const std::vector<Record>& records) {
  return header.name == Header{}.name && header.checksum == checksum_of(bytes_of(records));
}

}  // namespace

int write_at(int descriptor, std::uint64_t address, const void* bytes, std::uint64_t size) {
  const auto* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::pwrite(descriptor, next, size, static_cast<off_t>(address));
    if (count < 0 && errno != EINTR) return errno;
    if (count < 0) continue;
    next += count;
    address += static_cast<std::uint64_t>(count);
    size -= static_cast<std::uint64_t>(count);
  }
  return 0;
}

int read_at(int descriptor, std::uint64_t address, void* bytes, std::uint64_t size) {
  auto* next = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::pread(descriptor, next, size, static_cast<off_t>(address));
    if (count < 0 && errno != EINTR) return errno;
    if (count < 0) continue;
    if (count == 0) {
      std::memset(next, 0, size);
      return 0;
    }
    next += count;
    address += static_cast<std::uint64_t>(count);
    size -= static_cast<std::uint64_t>(count);
  }
  return 0;
}

int write_journal(int descriptor, const Pages& pages) {
  std::vector<Record> records;
  for (const auto& [number, bytes] : pages) records.push_back({number, bytes});
  Header header;
  header.num_pages = records.size();
  header.checksum = checksum_of(bytes_of(records));
  int error = write_at(descriptor, 0, &header, sizeof header);
  if (error == 0)
    error = write_at(descriptor, sizeof header, records.data(), records.size() * sizeof(Record));
  if (error == 0 && ::fdatasync(descriptor) != 0) error = errno;
  return error;
}

Pages read_journal(const std::string& path) {
  Pages pages;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return pages;
  struct stat status {};
  Header header;
  std::vector<Record> records;
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
      read_at(descriptor, 0, &header, sizeof header) == 0 &&
      header.num_pages <= static_cast<std::uint64_t>(status.st_size) / sizeof(Record)) {
    records.resize(header.num_pages);
    const bool is_read =
        read_at(descriptor, sizeof header, records.data(), records.size() * sizeof(Record)) == 0;
    if (is_read && is_whole(header, records))
      for (const Record& record : records) pages[record.number] = record.bytes;
  }
  ::close(descriptor);
  return pages;
}

}  // namespace vesica::io::hdf5
