#pragma once

#include <memory>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::solve {

/// The stepper named by `options.method`, which takes over `start` (positions and order parameter;
/// the rest is made consistent). Throws ConfigError for a wrong option, SolverError when no
/// consistent initial values are found.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(const SolverOptions& options,
                                                    const model::Model& model,
                                                    problem::State start);

/// How a run goes on from a state that was already in motion, for example on a new mesh.
struct Restart {
  double initial_step = 0;  ///< first step [time]; 0: chosen by the integrator
};

/// The stepper named by `options.method`, which goes on from `start` with all its values,
/// multipliers and rates as they are: they need not be consistent, because velocities that fit a
/// transferred shape exactly are dominated by its interpolation error. Counts and seconds begin at
/// zero. Throws ConfigError for a wrong option, or one other than method ida with scheme paper.
[[nodiscard]] std::unique_ptr<Stepper> restart_stepper(const SolverOptions& options,
                                                       const model::Model& model,
                                                       problem::State start,
                                                       const Restart& restart);

}  // namespace vesica::solve
