#pragma once

#include <memory>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::run {

/// Makes the stepper named by `options.method`, which takes over `start` (positions and order
/// parameter; the rest is made consistent). Throws ConfigError for a wrong option, SolverError when
/// no consistent initial values are found.
[[nodiscard]] std::unique_ptr<solve::Stepper> make_stepper(const solve::SolverOptions& options,
                                                           const model::Model& model,
                                                           problem::State start);

/// Makes the stepper named by `options.method`, which goes on from `start` with all its values,
/// multipliers and rates as they are: they need not be consistent, because velocities that fit a
/// transferred shape exactly are dominated by its interpolation error. Counts and seconds begin at
/// zero. Throws ConfigError for a wrong option, or the automatic method.
[[nodiscard]] std::unique_ptr<solve::Stepper> restart_stepper(const solve::SolverOptions& options,
                                                              const model::Model& model,
                                                              problem::State start,
                                                              const solve::Restart& restart);

}  // namespace vesica::run
