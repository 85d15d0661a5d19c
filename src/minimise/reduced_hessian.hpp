#pragma once

#include <Eigen/Core>

#include "vesica/linalg/sparse_cholesky.hpp"
#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::minimise {

/// The exact second derivative of the Lagrangian E_h + sum lambda_i C_i with respect to the
/// unknowns u = (d, c) of a normal graph, with the bending moment p at its maximum:
///
///   H = K_uu + K_up M_k^-1 K_pu,   K the second derivative in (p, d, c),  K_pp = -M_k
///
/// It is dense, so it is applied: two products with K and a solve with the mass matrix M_k, which
/// is weighted by 1/k_kappa.
class ReducedHessian {
 public:
  /// Assembles K at the fields, p included, and factorises M_k. Throws RecoverableError when the
  /// surface is degenerate.
  ReducedHessian(const problem::EnergyProblem& problem, const problem::EnergyFields& fields,
                 const problem::Multipliers& multipliers, const problem::NormalGraph& graph,
                 int threads);

  /// Returns H u, shape (N) or (2N).
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& u) const;

 private:
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& y) const;

  Eigen::Index num_nodes_;
  Eigen::Index block_;  // unknowns of a node: p, d and, for two phases, c
  int threads_;
  linalg::SparseMatrix matrix_;
  linalg::SparseCholesky mass_;
};

}  // namespace vesica::minimise
