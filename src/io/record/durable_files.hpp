#pragma once

#include <filesystem>
#include <string_view>

/// Changes of files that the disk has when the call returns, or of which nothing is seen. All throw
/// IoError.
namespace vesica::io {

/// Writes a new file in place of what has its name; a link of that name is not followed.
void write_durably(const std::filesystem::path& path, std::string_view text);
/// Renames a file; the folder has to be synchronised afterwards.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// Does nothing when there is no such file.
void remove_file(const std::filesystem::path& path);
/// Waits until the disk has what was renamed and removed in a folder.
void synchronise_folder(const std::filesystem::path& folder);

}  // namespace vesica::io
