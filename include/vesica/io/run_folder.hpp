#pragma once

#include <filesystem>
#include <string_view>

namespace vesica::io {

/// Whether a run may be written to `folder`; nothing is created. Throws ConfigError when it holds a
/// run (a finished one, or the `trajectory.part.h5` of one that goes on or broke off) and
/// `overwrite` is false, or when `case_file` is the file `case.toml` in it; IoError when it is no
/// folder or is not writable.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& case_file,
                      bool overwrite);

/// Makes the folder and its parents. Throws IoError.
void create_run_folder(const std::filesystem::path& folder);

/// Writes to `<path>.tmp` and renames it, so that `path` is either the old file or the whole new
/// one. Throws IoError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace vesica::io
