#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "vesica/config/config.hpp"
#include "vesica/io/progress.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::run {

/// Options that a program adds to a configuration: files or none, progress, its own observers and
/// controllers, an interrupt. What its pointers name must outlive the call.
struct Options {
  bool writes_files = true;           ///< false: neither the output folder nor a file is made
  bool overwrites = false;            ///< true: a run that is in the output folder is replaced
  std::filesystem::path case_file{};  ///< is not to be replaced by the files of the run
  /// Folder of the run to go on with; empty: a new start. Where it is the output folder, too, the
  /// files of that run go on, whatever `overwrites` says.
  std::filesystem::path resumed{};
  std::ostream* progress = nullptr;  ///< gets the lines of io::Progress; null: nobody does
  io::ProgressStyle progress_style = io::ProgressStyle::sparse;
  std::vector<relax::Observer*> observers{};      ///< look after trajectory and progress
  std::vector<relax::Controller*> controllers{};  ///< see `run` for their place in the order
  /// Number of the signal that is to end the run after the present step, 0 as long as there is
  /// none; a signal handler or another thread may store it. Null: the run is not interrupted.
  const std::atomic<int>* interrupt = nullptr;
};

/// Result of a run: how it ended, its last good state, and warnings about its case.
struct Result {
  relax::Verdict verdict;             ///< with the outcome: status, reason, energies, counts
  problem::State state;               ///< the last good one
  std::vector<std::string> warnings;  ///< those of the case, one sentence each
};

/// Refuses what can be refused before work begins (options of the damping, and an output folder
/// that cannot take the run), then makes the case of `config`: by setup::make_case or, where
/// `options.resumed` names a run, by io::resumed_case. Writes nothing. Throws ConfigError, which
/// tells where a key was written, and IoError.
[[nodiscard]] setup::Case prepare(const config::RunConfig& config, const Options& options = {});

/// Relaxes the vesicle of `config` and returns the verdict with the final state: prepares the case,
/// makes the stepper of `config.solver`, and runs relax::relax. Writes trajectory, verdict and
/// effective configuration to `config.output.directory` unless `options.writes_files` is false.
///
/// The controllers are asked in this order: damping, interrupt, those of `options`, necks,
/// self-intersections, changes of the mesh. The first Stop and the first Remesh count, and the last
/// SetDamping; so those of `options` go before those of the library except the interrupt.
///
/// Numerical trouble is in the verdict, with status numerical_failure: also when no consistent
/// initial values exist, where energies and velocities are NaN, the state is the start, and
/// observers see nothing but `finish`. Throws what `prepare` throws, ConfigError for options that
/// the solver refuses, IoError when a file cannot be written, and what observers and controllers
/// throw.
[[nodiscard]] Result run(const config::RunConfig& config, const Options& options = {});

/// Relaxes a case that the program has made, by `prepare` or by setup::case_of from a surface of
/// the program's own; `config.shape`, `config.phase` and `options.resumed` are not used then.
[[nodiscard]] Result run(const config::RunConfig& config, const setup::Case& vesicle,
                         const Options& options = {});

}  // namespace vesica::run
