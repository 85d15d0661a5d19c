#pragma once

#include "solve/newton_system.hpp"
#include "sundials.hpp"

namespace vesica::flow {

/// A SUNMatrix that stands for the matrix inside a NewtonSystem; IDA only asks for its kind and to
/// zero it.
[[nodiscard]] sundials::Matrix make_system_matrix(const sundials::Context& context);

/// A direct SUNLinearSolver that solves with the factors of `system`, which outlives it.
[[nodiscard]] sundials::LinearSolver make_system_solver(solve::NewtonSystem& system,
                                                        const sundials::Context& context);

}  // namespace vesica::flow
