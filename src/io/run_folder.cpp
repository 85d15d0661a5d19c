#include "vesica/io/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "io/record/durable_files.hpp"
#include "io/record/file_names.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> files_of_a_run{file_names::record, file_names::part,
                                                    file_names::verdict, file_names::configuration,
                                                    file_names::checkpoint};

std::string last_system_error() { return std::generic_category().message(errno); }

/// The folder itself, or the nearest one above it that exists.
fs::path nearest_existing(const fs::path& folder) {
  std::error_code ignored;
  fs::path existing = fs::absolute(folder);
  while (!fs::exists(existing, ignored) && existing.has_relative_path())
    existing = existing.parent_path();
  return existing;
}

}  // namespace

void check_run_folder(const fs::path& folder, const fs::path& case_file, bool overwrite) {
  std::error_code ignored;
  const fs::path existing = nearest_existing(folder);
  if (!fs::is_directory(existing, ignored)) {
    throw IoError(
        fmt::format("{}: cannot be made, {} is not a folder", folder.string(), existing.string()));
  }
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    throw IoError(fmt::format("{}: not writable ({})", existing.string(), last_system_error()));
  }
  if (fs::equivalent(folder / "case.toml", case_file, ignored)) {
    throw ConfigError(fmt::format("{}: holds the case file itself; choose another output folder",
                                  folder.string()));
  }
  if (fs::is_directory(folder, ignored)) const FolderLock free(folder);
  if (!overwrite) check_holds_no_run(folder);
}

void check_holds_no_run(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : files_of_a_run) {
    if (fs::exists(folder / name, ignored)) {
      throw ConfigError(fmt::format(
          "{}: already holds a run ({}); choose another output folder or give --overwrite",
          folder.string(), name));
    }
  }
}

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw IoError(fmt::format("{}: cannot be opened ({})", folder.string(), last_system_error()));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw ConfigError(fmt::format("{}: a run is writing to it; choose another output folder or wait",
                                folder.string()));
}

FolderLock::~FolderLock() { ::close(descriptor_); }

void create_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw IoError(fmt::format("{}: cannot be made ({})", folder.string(), error.message()));
}

void write_text_file(const fs::path& path, std::string_view text) {
  const fs::path temporary = path.string() + ".tmp";
  write_durably(temporary, text);
  rename_file(temporary, path);
}

}  // namespace vesica::io
