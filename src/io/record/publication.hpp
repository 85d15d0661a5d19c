#pragma once

#include <filesystem>

#include "vesica/setup/case.hpp"

namespace vesica::io {

/// Gives the files of a run that has ended their names: first the record, from `trajectory.part.h5`
/// if there is one, `verdict.json` last; all are on the disk before. `verdict.json`, `case.toml`
/// and `trajectory.xdmf` are copies of what the record holds, so the call can be repeated when
/// something ended it. Throws IoError.
void publish(const std::filesystem::path& folder);

/// Whether publish() has not been carried out to its end in a folder with a record that has ended.
[[nodiscard]] bool is_unpublished(const std::filesystem::path& folder);

/// First line of `case.toml`, "# run <number>".
[[nodiscard]] std::string first_line(const std::string& run);

/// Whether the case was resumed from `folder`, so that its record goes on.
[[nodiscard]] bool goes_on_in(const std::filesystem::path& folder, const setup::Case& vesicle);

}  // namespace vesica::io
