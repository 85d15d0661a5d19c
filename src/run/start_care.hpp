#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "vesica/setup/case.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::run {

/// A start that was made fit for its run, and in sentences what was done to it.
struct FitStart {
  problem::State state;
  std::vector<std::string> notes{};
};

/// Takes the start of a case to its targets where it is off by more than 0.02 of them, by
/// minimise::approach_targets. `interrupt` as in Options. Where the targets are not reached the
/// start stays as it is, with a note.
[[nodiscard]] FitStart near_targets(const setup::Case& vesicle, const solve::SolverOptions& options,
                                    const std::atomic<int>* interrupt);

/// Makes a rough start smooth before its mesh is adapted, by some steps of minimisation on the mesh it
/// has: of a rough surface, normals of whose neighbouring elements differ by more than 53 degrees,
/// the size field sees curvature that is noise.
void smooth_before_adaption(const solve::SolverOptions& options, const model::Model& model,
                            FitStart& start);

/// Makes the stepper of a run. Where a flow finds no initial values since the start is too rough,
/// some steps of minimisation go first, with material and targets as they are at the start. Throws
/// SolverError when that does not help.
[[nodiscard]] std::unique_ptr<solve::Stepper> make_stepper_somehow(
    const solve::SolverOptions& options, const model::Model& model, FitStart& start);

}  // namespace vesica::run
