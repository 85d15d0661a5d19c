#pragma once

#include "augmented_energy.hpp"

namespace vesica::minimise {

/// Limits at which an inner minimisation ends.
struct InnerLimits {
  int iterations = 20;
  double gradient = 0;  ///< of the augmented Lagrangian with respect to y, in the energy unit
  double move = 0;      ///< max|d| of an accepted point [length]
};

struct InnerResult {
  GraphPoint point;  ///< the last accepted one
  long iterations = 0;
  long evaluations = 0;
  long refusals = 0;
  double decrease = 0;  ///< of the augmented Lagrangian, in the energy unit
  solve::SolverSeconds seconds;
};

/// Minimises by L-BFGS of `ceres::GradientProblemSolver` with a Wolfe line search, from y = 0 at
/// `start`. Exceptions other than RecoverableError pass through.
[[nodiscard]] InnerResult minimise_inner(const InnerProblem& problem, const GraphPoint& start,
                                         const InnerLimits& limits);

}  // namespace vesica::minimise
