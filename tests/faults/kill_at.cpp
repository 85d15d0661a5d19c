// A library for LD_PRELOAD that counts the calls with which a program changes files, and kills it just before one of
// them: number KILL_AT. With KILL_PARTIAL=1 half of the bytes of that write reach the file before. With POWER_LOSS=seed
// the pages that were written since the file was last synchronised are kept or lost at random, as when the power fails.
// At a regular end the number of calls is written to COUNT_FILE. Standard output and error do not count.

#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <random>
#include <utility>

namespace {

std::atomic<long> calls{0};

long number_of(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::atol(text);
}

bool is_the_one() {
  static const long last = number_of("KILL_AT");
  return ++calls == last;
}

bool is_partial() { return number_of("KILL_PARTIAL") != 0; }

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

ssize_t really_write_at(int file, const void* bytes, std::size_t size, off_t offset) {
  static auto* const call = real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  return call(file, bytes, size, offset);
}

/// What the disk may still hold in place of pages that were written: their contents at the last
/// synchronisation, by file descriptor and number.
class LostPages {
 public:
  void remember(int file, off_t offset, std::size_t size) {
    if (size == 0 || number_of("POWER_LOSS") == 0) return;
    const std::lock_guard lock(mutex_);
    const off_t last = (offset + static_cast<off_t>(size) - 1) / page;
    for (off_t number = offset / page; number <= last; ++number) {
      const auto [place, is_new] = old_.try_emplace({file, number});
      if (is_new) (void)::pread(file, place->second.data(), page, number * page);
    }
  }
  void forget(int file) {
    const std::lock_guard lock(mutex_);
    std::erase_if(old_, [file](const auto& entry) { return entry.first.first == file; });
  }
  /// The descriptor is about to be closed.
  void keep(int file) {
    const std::lock_guard lock(mutex_);
    std::map<std::pair<int, off_t>, Page> kept;
    for (const auto& [place, contents] : old_)
      if (place.first == file) kept[place] = contents;
    if (kept.empty()) return;
    const int copy = ::dup(file);
    for (const auto& [place, contents] : kept) {
      old_[{copy, place.second}] = contents;
      old_.erase(place);
    }
  }
  void lose() {
    const std::lock_guard lock(mutex_);
    std::minstd_rand random(static_cast<unsigned>(number_of("POWER_LOSS")));
    for (const auto& [place, contents] : old_)
      if (random() % 2 == 0)
        (void)really_write_at(place.first, contents.data(), page, place.second * page);
  }

 private:
  static constexpr off_t page = 4096;
  using Page = std::array<char, page>;
  std::mutex mutex_;
  std::map<std::pair<int, off_t>, Page> old_;
};

LostPages& lost_pages() {
  static auto* const pages = new LostPages;  // files are closed until the very end
  return *pages;
}

[[noreturn]] void die() {
  lost_pages().lose();
  for (;;) std::raise(SIGKILL);
}

struct CountFile {
  ~CountFile() {
    const char* const name = std::getenv("COUNT_FILE");
    std::FILE* const file = name == nullptr ? nullptr : std::fopen(name, "w");
    if (file == nullptr) return;
    std::fprintf(file, "%ld\n", calls.load());
    std::fclose(file);
  }
} const count_file;

}  // namespace

extern "C" {

ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  lost_pages().remember(file, offset, size);
  if (is_the_one()) {
    if (is_partial()) (void)really_write_at(file, bytes, size / 2, offset);
    die();
  }
  return really_write_at(file, bytes, size, offset);
}

ssize_t pwrite64(int file, const void* bytes, std::size_t size, off_t offset) {
  return pwrite(file, bytes, size, offset);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static auto* const call = real<ssize_t(int, const void*, std::size_t)>("write");
  if (file <= STDERR_FILENO) return call(file, bytes, size);
  if (const off_t place = ::lseek(file, 0, SEEK_CUR); place >= 0)
    lost_pages().remember(file, place, size);
  if (is_the_one()) {
    if (is_partial()) (void)call(file, bytes, size / 2);
    die();
  }
  return call(file, bytes, size);
}

int fdatasync(int file) {
  static auto* const call = real<int(int)>("fdatasync");
  const int result = call(file);
  if (result == 0) lost_pages().forget(file);
  return result;
}

int fsync(int file) {
  static auto* const call = real<int(int)>("fsync");
  const int result = call(file);
  if (result == 0) lost_pages().forget(file);
  return result;
}

int close(int file) {
  static auto* const call = real<int(int)>("close");
  lost_pages().keep(file);
  return call(file);
}

int ftruncate(int file, off_t size) noexcept {
  static auto* const call = real<int(int, off_t)>("ftruncate");
  if (is_the_one()) die();
  return call(file, size);
}

int ftruncate64(int file, off_t size) noexcept { return ftruncate(file, size); }

int posix_fallocate(int file, off_t offset, off_t size) {
  static auto* const call = real<int(int, off_t, off_t)>("posix_fallocate");
  if (is_the_one()) die();
  return call(file, offset, size);
}

int posix_fallocate64(int file, off_t offset, off_t size) {
  return posix_fallocate(file, offset, size);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const call = real<int(const char*, const char*)>("rename");
  if (is_the_one()) die();
  return call(from, to);
}

int unlink(const char* path) noexcept {
  static auto* const call = real<int(const char*)>("unlink");
  if (is_the_one()) die();
  return call(path);
}

int remove(const char* path) noexcept {
  static auto* const call = real<int(const char*)>("remove");
  if (is_the_one()) die();
  return call(path);
}
}
