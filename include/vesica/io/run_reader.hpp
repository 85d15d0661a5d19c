#pragma once

#include <filesystem>
#include <vector>

#include "vesica/io/case.hpp"
#include "vesica/io/config.hpp"
#include "vesica/io/verdict.hpp"

namespace vesica::io {

/// How the energy fell; one value a step, the start included. The single energy of a run whose
/// initial values could not be made consistent is NaN.
struct EnergyHistory {
  std::vector<double> step;
  std::vector<double> seconds;  ///< wall clock, since the start of the run
  std::vector<double> energy;   ///< total [energy]
};

/// What a run leaves in its folder.
struct FinishedRun {
  RunConfig config;
  model::Model model;
  problem::State state;  ///< the final one; rates of the positions alone
  Verdict verdict;       ///< with the numbers of `verdict.json`
  EnergyHistory history;
};

/// Reads a run that has ended back from `case.toml`, `trajectory.h5` and `verdict.json`. Throws
/// IoError for a folder without an ended run and for files that cannot be read or contradict each
/// other, ConfigError for a wrong `case.toml`.
[[nodiscard]] FinishedRun read_run(const std::filesystem::path& folder);

/// The case of `config` with the final state of the run in `folder` as its start, rates and
/// multipliers included; of a run that broke off (`trajectory.part.h5` alone) the last frame that
/// is complete. Time goes on. "initial" is the start of the first run of such a chain. Throws what
/// read_run throws, and ConfigError when a run is writing to the folder or when one has a phase
/// field and the other not.
[[nodiscard]] Case resumed_case(const RunConfig& config, const std::filesystem::path& folder);

/// The energy history of a run that has ended. Throws IoError.
[[nodiscard]] EnergyHistory read_history(const std::filesystem::path& folder);

}  // namespace vesica::io
