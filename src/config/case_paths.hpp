#pragma once

#include <filesystem>

#include "config/case_document.hpp"
#include "vesica/config/config.hpp"

namespace vesica::config {

/// Makes the relative paths of files in `config` absolute, as read_config promises; `folder` is
/// that of the case file.
void locate_files(const CaseDocument& document, const std::filesystem::path& folder,
                  RunConfig& config);

/// The same configuration whose relative paths of files, to the current folder, are absolute.
[[nodiscard]] RunConfig with_absolute_paths(RunConfig config);

}  // namespace vesica::config
