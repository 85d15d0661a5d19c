// A library for LD_PRELOAD that counts the calls with which a program changes files, and kills it just before one of
// them: number KILL_AT. With KILL_PARTIAL=1 half of the bytes of that write reach the file before. At a regular end the
// number of calls is written to COUNT_FILE. Standard output and error do not count.

#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

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

[[noreturn]] void die() {
  for (;;) std::raise(SIGKILL);
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
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
  static auto* const call = real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  if (is_the_one()) {
    if (is_partial()) (void)call(file, bytes, size / 2, offset);
    die();
  }
  return call(file, bytes, size, offset);
}

ssize_t pwrite64(int file, const void* bytes, std::size_t size, off_t offset) {
  return pwrite(file, bytes, size, offset);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static auto* const call = real<ssize_t(int, const void*, std::size_t)>("write");
  if (file > STDERR_FILENO && is_the_one()) {
    if (is_partial()) (void)call(file, bytes, size / 2);
    die();
  }
  return call(file, bytes, size);
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
