#pragma once

#include <Eigen/Core>
#include <optional>

#include "solve/newton_system.hpp"
#include "sundials.hpp"

namespace vesica::flow {

/// One backward-Euler step of the relaxation flow with the constraints themselves in place of (e).
struct BackwardEulerStep {
  problem::EquationSettings settings;  ///< `form` is overridden
  double time = 0;                     ///< time at the end of the step
  double step_size = 0;
  Eigen::VectorXd start;         ///< y at its beginning
  Eigen::VectorXd differential;  ///< 1 where an unknown has a rate
  Eigen::VectorXd weights;       ///< inverse size of a negligible change of each unknown
  int max_iterations = 8;        ///< of Newton's method

  [[nodiscard]] Eigen::VectorXd rates(const Eigen::VectorXd& y) const {
    return (y - start).cwiseProduct(differential) / step_size;
  }
};

/// Solves it by KINSOL's Newton method; linear systems by GMRES on difference quotients of the
/// residual, exact where the Jacobian holds a surrogate, or on the products of the system, with
/// what it sets up at the start as preconditioner. Returns y, or nothing when the changes do not
/// become negligible (WRMS norm below 1e-6) in max_iterations. Throws RecoverableError for a
/// degenerate surface.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_backward_euler(solve::NewtonSystem& system,
                                                                  const BackwardEulerStep& step);

}  // namespace vesica::flow
