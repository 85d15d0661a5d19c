#pragma once

#include "vesica/config/config.hpp"
#include "vesica/io/verdict_files.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/setup/case.hpp"

namespace vesica {

/// How a run ended and where.
struct RunResult {
  relax::Verdict verdict;
  problem::State state;  ///< the last good one
};

/// Refuses what can be refused before anything is written: options of the damping, and a folder
/// that cannot take the run. Throws ConfigError and IoError.
void check_run(const config::RunConfig& config, const std::string& case_file, bool overwrites);

/// Relaxes `vesicle` and writes all files of the run to `config.output.directory`; a line of
/// progress goes to the terminal unless `is_quiet`. Throws IoError and ConfigError; numerical
/// trouble is in the verdict.
[[nodiscard]] RunResult run_case(const config::RunConfig& config, const setup::Case& vesicle,
                                 relax::Controller& interrupt, bool is_quiet);

}  // namespace vesica
