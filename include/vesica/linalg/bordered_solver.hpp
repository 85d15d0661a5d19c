#pragma once

#include <Eigen/Core>
#include <memory>

#include "vesica/linalg/dense.hpp"
#include "vesica/linalg/direct_solver.hpp"

namespace vesica::linalg {

/// Sparse matrix K bordered by a few dense columns and rows:
///
///     [ K     columns ]      K (n, n),  columns (n, m),  rows (m, n),  corner (m, m)
///     [ rows  corner  ]
struct BorderedMatrix {
  SparseMatrix block;
  Eigen::MatrixXd columns;
  Eigen::MatrixXd rows;
  Eigen::MatrixXd corner;  ///< may be empty: zero

  [[nodiscard]] Eigen::Index size() const { return columns.rows() + columns.cols(); }
  /// Returns A x, of length n + m.
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;
};

/// Solves bordered systems by block elimination with one factorisation of K: dense rows never enter
/// the factors.
class BorderedSolver {
 public:
  /// Makes the solver and analyses the pattern of `matrix.block`, once.
  BorderedSolver(DirectSolverKind kind, const BorderedMatrix& matrix, int block_size);

  /// Factorises a matrix of the same pattern. Throws RecoverableError when K or the border is
  /// singular.
  void factorise(const BorderedMatrix& matrix);
  /// Returns x = A^-1 b, both of length n + m.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Returns A^-1 b to some five digits at least, as DirectSolver::precondition.
  [[nodiscard]] Eigen::VectorXd precondition(const Eigen::VectorXd& b) const;

 private:
  /// Returns A^-1 b from K^-1 of its head.
  [[nodiscard]] Eigen::VectorXd join(const Eigen::VectorXd& head, const Eigen::VectorXd& b) const;

  std::unique_ptr<DirectSolver> direct_;
  Eigen::MatrixXd rows_;
  Eigen::MatrixXd solved_columns_;  // K^-1 columns
  DenseLu schur_;
};

}  // namespace vesica::linalg
