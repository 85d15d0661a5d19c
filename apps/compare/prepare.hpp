#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "vesica/config/config.hpp"
#include "vesica/setup/case.hpp"

namespace vesica {

/// A run that can begin.
struct PreparedRun {
  std::string name;
  config::RunConfig config;
  setup::Case vesicle;
};

/// All runs of a case, and the folder that takes them.
struct PreparedComparison {
  std::vector<PreparedRun> runs;
  std::filesystem::path folder;
};

/// Reads and checks what the runs need, so that nothing is written before all of them are known to
/// be possible; warnings of the case go to the standard error output. Throws ConfigError and
/// IoError.
[[nodiscard]] PreparedComparison prepare(const Arguments& arguments);

}  // namespace vesica
