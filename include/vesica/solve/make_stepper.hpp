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

}  // namespace vesica::solve
