#pragma once

#include <Eigen/Core>

#include "vesica/core/scoped_timer.hpp"
#include "vesica/linalg/bordered_solver.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::solve {

/// Jacobian of a FlowProblem and its factors, with the counts and seconds they cost. One
/// symbolic factorisation serves all matrices of a mesh.
class NewtonSystem {
 public:
  NewtonSystem(const problem::FlowProblem& problem, linalg::DirectSolverKind kind);

  [[nodiscard]] Eigen::VectorXd residual(const problem::EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate);
  /// Assembles and factorises.
  void set_up(const problem::EquationSettings& settings, const problem::JacobianWeights& weights,
              double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate);
  /// Solves with the last factors.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// The same with one step of iterative refinement.
  [[nodiscard]] Eigen::VectorXd solve_accurately(const Eigen::VectorXd& b);

  [[nodiscard]] const SolverCounts& counts() const { return counts_; }
  [[nodiscard]] const SolverSeconds& seconds() const { return seconds_; }

 private:
  const problem::FlowProblem& problem_;
  linalg::BorderedMatrix matrix_;
  linalg::BorderedSolver solver_;
  SolverCounts counts_;
  SolverSeconds seconds_;
};

}  // namespace vesica::solve
