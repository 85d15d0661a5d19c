#pragma once

#include <Eigen/Core>
#include <memory>

#include "problem/reduced_problem.hpp"
#include "vesica/core/scoped_timer.hpp"
#include "vesica/linalg/bordered_solver.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::solve {

/// The equations of a flow with their Jacobian and its inverse, with the counts and seconds they
/// cost. The inverse is exact, by factors of the assembled Jacobian, or the approximate one of a
/// ReducedProblem, which has products with the exact Jacobian beside it. Patterns are analysed
/// once.
class NewtonSystem {
 public:
  NewtonSystem(const problem::AssembledProblem& problem, linalg::DirectSolverKind kind);
  NewtonSystem(const problem::ReducedProblem& problem, const problem::Scales& scales);
  ~NewtonSystem();

  [[nodiscard]] Eigen::VectorXd residual(const problem::EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate);
  /// Prepares `solve`: assembles and factorises.
  void set_up(const problem::EquationSettings& settings, const problem::JacobianWeights& weights,
              double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate);
  /// Solves with what was set up last.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// The same to some five digits at least, which may be faster.
  [[nodiscard]] Eigen::VectorXd precondition(const Eigen::VectorXd& b);
  /// Solves with one step of iterative refinement, for an assembled Jacobian.
  [[nodiscard]] Eigen::VectorXd solve_accurately(const Eigen::VectorXd& b);

  /// Tells whether the products below are to be had.
  [[nodiscard]] bool has_products() const { return reduced_ != nullptr; }
  /// Fixes the point of `product`.
  void linearise(const problem::EquationSettings& settings, double time, const Eigen::VectorXd& y,
                 const Eigen::VectorXd& y_rate);
  /// Computes the product of the Jacobian with v.
  [[nodiscard]] Eigen::VectorXd product(const problem::JacobianWeights& weights,
                                        const Eigen::VectorXd& v);

  /// Computes the fields and the energy of y; what the last residual has found there is used.
  [[nodiscard]] problem::Fields values(double time, const Eigen::VectorXd& y);
  [[nodiscard]] std::optional<model::EnergyParts> energy(double time, const Eigen::VectorXd& y);

  [[nodiscard]] const SolverCounts& counts() const { return counts_; }
  [[nodiscard]] const SolverSeconds& seconds() const { return seconds_; }

 private:
  struct Assembled;
  struct Reduced;

  const problem::FlowProblem& problem_;
  std::unique_ptr<Assembled> assembled_;  // one of the two
  std::unique_ptr<Reduced> reduced_;
  SolverCounts counts_;
  SolverSeconds seconds_;
};

}  // namespace vesica::solve
