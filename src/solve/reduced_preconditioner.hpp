#pragma once

#include <Eigen/Core>

#include "linalg/supernodal_cholesky.hpp"
#include "problem/reduced_problem.hpp"
#include "vesica/linalg/dense.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::solve {

/// An approximate inverse of the Jacobian of a ReducedProblem from factors of second-order
/// operators alone. For d, whose operator is of fourth order, T M^-1 T with
///
///     T = int |n_i . nu| [ sqrt(k) grad . grad + max(sqrt(cj), s sqrt(k)) ],   s = 2 / R_c^2,
///
/// a real square root: (a + b)^2 is within a factor 2 of a^2 + b^2. For c its own operator, held
/// positive. Multipliers by the Schur complement. The condition number, and with it the number of
/// Krylov iterations, does not grow with the number of nodes.
class ReducedPreconditioner {
 public:
  /// Makes the preconditioner of `problem`, which outlives it; patterns are analysed once.
  ReducedPreconditioner(const problem::ReducedProblem& problem, const problem::Scales& scales);

  /// Assembles and factorises for the Jacobian at a point. With weights {0, 1} the metric of the
  /// flow takes the place of both operators. Throws RecoverableError when the border is singular.
  void set_up(const problem::ReducedPoint& point, const problem::ReducedLinearisation& there,
              const problem::JacobianWeights& weights);
  /// Solves with it, b of shape (size()).
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  /// Returns T, or the metric, and sets the mass matrix between two of T^-1.
  [[nodiscard]] linalg::SparseMatrix bending_operator(const problem::ReducedPoint& point,
                                                      const problem::JacobianWeights& weights);
  [[nodiscard]] linalg::SparseMatrix phase_operator(const problem::ReducedPoint& point,
                                                    const problem::JacobianWeights& weights) const;
  [[nodiscard]] Eigen::MatrixXd solve_nodal(const Eigen::MatrixXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve_bending(const Eigen::MatrixXd& b) const;

  const problem::ReducedProblem& problem_;
  double shift_;  // s
  linalg::SupernodalCholesky bending_;
  linalg::SupernodalCholesky phase_;
  linalg::SparseMatrix mass_;
  bool is_metric_ = false;  // weights {0, 1}: no T, the metric itself
  Eigen::MatrixXd rows_;
  Eigen::MatrixXd solved_columns_;
  linalg::DenseLu schur_;
};

}  // namespace vesica::solve
