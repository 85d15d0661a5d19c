#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vesica/compare/comparison.hpp"
#include "vesica/config/config.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// A run that has ended, as it is read from its folder.
struct FinishedRun {
  config::RunConfig config;
  model::Model model;
  problem::State state;    ///< the final one; rates of the positions alone
  relax::Verdict verdict;  ///< with the numbers of `verdict.json`
  compare::EnergyHistory history;
};

/// Reads a run that has ended back from `case.toml`, `trajectory.h5` and `verdict.json`. Throws
/// IoError for a folder without an ended run and for files that cannot be read, were damaged or
/// belong to different runs, ConfigError for a wrong `case.toml`.
[[nodiscard]] FinishedRun read_run(const std::filesystem::path& folder);

/// A frame of a trajectory.
struct Frame {
  problem::State state;   ///< rates of the positions alone
  std::size_t index = 0;  ///< from 0
  std::size_t count = 0;  ///< of the frames of the run
};

/// Reads a frame of a run that has ended, goes on or broke off; without `index` the last one.
/// Throws IoError for a folder without a trajectory, ConfigError for a frame that there is not.
[[nodiscard]] Frame read_frame(const std::filesystem::path& folder,
                               std::optional<std::size_t> index);

/// Makes the case of `config` with the final state of the run in `folder` as its start, rates and
/// multipliers included; of a run that goes no further (`trajectory.part.h5`) the last frame. Where
/// frames were damaged the last one before them is taken, with a warning. Time goes on. "initial"
/// is the start of the first run of such a chain. Warnings name the options that differ from those
/// of the run. Throws what read_run throws, and ConfigError when a run is writing to the folder,
/// when one has a phase field and the other not, and for another `[shape]` or `[phase]`.
[[nodiscard]] setup::Case resumed_case(const config::RunConfig& config,
                                       const std::filesystem::path& folder);

/// Reads the configuration of a run, ended or not, from its record, and then `overrides` as
/// config::read_config does; its folder is that of the record. Throws IoError and ConfigError.
[[nodiscard]] config::RunConfig recorded_config(const std::filesystem::path& folder,
                                                std::span<const std::string> overrides);

/// Returns the verdict of a run in `folder` that has converged and would go on with the options it
/// had: nothing is left to do. Gives its files their names where a kill kept the run from that.
/// Throws IoError and ConfigError.
[[nodiscard]] std::optional<relax::Verdict> find_conclusion(const config::RunConfig& config,
                                                            const std::filesystem::path& folder);

/// Lets the program end without the clean-up of HDF5, which complains of parts of a damaged file
/// that it has kept open itself. For programs that leave HDF5 to this library; to be called before
/// anything is read or written.
void leave_hdf5_without_cleanup();

/// Reads the energy history of a run that has ended. Throws IoError.
[[nodiscard]] compare::EnergyHistory read_history(const std::filesystem::path& folder);

}  // namespace vesica::io
