#pragma once

#include <Eigen/Core>
#include <memory>

#include "vesica/linalg/sparse_matrix.hpp"

namespace vesica::linalg {

/// Cholesky factors of a sparse symmetric positive definite matrix, A = C C^T with C = P^T L (P the
/// fill-reducing permutation). The factor is usable by itself: C^-T y has the covariance A^-1, so
/// it is a change of variables that turns A into the identity. The pattern is analysed once.
class SparseCholesky {
 public:
  /// Makes the factorisation for all matrices with the pattern of `pattern`, whose values do not
  /// matter.
  explicit SparseCholesky(const SparseMatrix& pattern);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Computes the factors; reads the lower triangle. Throws RecoverableError when the matrix is not
  /// positive definite.
  void factorise(const SparseMatrix& matrix);

  /// Returns A^-1 b.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Returns C y.
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& y) const;
  /// Returns C^T x.
  [[nodiscard]] Eigen::VectorXd multiply_transposed(const Eigen::VectorXd& x) const;
  /// Returns C^-1 b.
  [[nodiscard]] Eigen::VectorXd solve_factor(const Eigen::VectorXd& b) const;
  /// Returns C^-T y.
  [[nodiscard]] Eigen::VectorXd solve_transposed(const Eigen::VectorXd& y) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace vesica::linalg
