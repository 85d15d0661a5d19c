#pragma once

#include <Eigen/Core>

#include "vesica/linalg/sparse_cholesky.hpp"
#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::minimise {

/// The metric in which the discrete energy looks like a sphere: unknowns u = (d, c), normal
/// displacements before order parameter, shape (N) or (2N), and
///
///   u = P^(1/2) z  with  d = S^-1 C z_d,  S = int sqrt(k) (grad . grad + 2/R_c^2),  C C^T = M,
///                        c = L^-T z_c,    L L^T = sigma eps K + (sigma/eps) max(1/2, psi''(c)) M
///
/// so that S M^-1 S stands for the fourth-order bending operator and only second-order operators
/// are factorised. z has the unit energy^(1/2), and |z|^2 / 2 is about the energy of a small
/// change.
class EnergyMetric {
 public:
  EnergyMetric(const problem::EnergyProblem& problem, const problem::Scales& scales);

  /// Takes the operators on a surface; three factorisations, two for a single phase. Throws
  /// RecoverableError when the surface is degenerate.
  void factorise(const mesh::Positions& positions, const Eigen::VectorXd& order_parameter);

  [[nodiscard]] Eigen::Index size() const { return is_two_phase_ ? 2 * num_nodes_ : num_nodes_; }
  /// Returns P^(1/2) z, a change of the unknowns.
  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& z) const;
  /// Returns P^(T/2) g for a derivative g with respect to the unknowns: the derivative with respect
  /// to z.
  [[nodiscard]] Eigen::VectorXd gather(const Eigen::VectorXd& gradient) const;
  /// Returns M^-1 g for both parts of a derivative g: the L2 gradient.
  [[nodiscard]] Eigen::VectorXd l2_gradient(const Eigen::VectorXd& gradient) const;

 private:
  const problem::EnergyProblem& problem_;
  double curvature_squared_;  // 2 / R_c^2
  double smallest_tension_;   // a phase field needs a metric at sigma = 0 as well
  bool is_two_phase_;
  Eigen::Index num_nodes_;
  linalg::SparseCholesky bending_;
  linalg::SparseCholesky mass_;
  linalg::SparseCholesky phase_;
};

}  // namespace vesica::minimise
