#pragma once

#include <filesystem>
#include <string_view>

namespace vesica::io {

/// Checks that a run may be written to `folder`; nothing is created. Throws ConfigError when the
/// folder holds a run (a finished one, or the `trajectory.part.h5` of one that broke off) and
/// `overwrite` is false, when a run is writing to it (FolderLock), or when `case_file` is the file
/// `case.toml` in it; IoError when it is no folder or is not writable.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& case_file,
                      bool overwrite);

/// Throws ConfigError when the folder holds a run.
void check_holds_no_run(const std::filesystem::path& folder);

/// A lock that keeps other runs out of a folder, also those of other processes, as long as it lives
/// (flock). Does nothing on file systems without locks.
class FolderLock {
 public:
  /// Takes the lock. Throws ConfigError when another lock holds the folder, IoError when it cannot
  /// be opened.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};

/// Makes the folder and its parents. Throws IoError.
void create_run_folder(const std::filesystem::path& folder);

/// Writes a text to `<path>.tmp`, waits until the disk has it, and renames it to `path`, so that
/// `path` is either the old file or the whole new one. Throws IoError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace vesica::io
