#pragma once

#include <Eigen/Core>
#include <memory>

namespace vesica::linalg {

// Eigen's decompositions of small dense matrices, compiled once.

/// Eigenvalues of a symmetric matrix in ascending order; its orthonormal eigenvectors as columns.
struct Eigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Returns the eigenvalues and eigenvectors of a symmetric matrix, of which the lower half is read;
/// not-a-number where the matrix is not finite.
[[nodiscard]] Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& matrix);

/// The thin decomposition A = left * diag(values) * right^T; the values descend.
struct SingularSystem {
  Eigen::MatrixXd left;
  Eigen::VectorXd values;
  Eigen::MatrixXd right;

  /// Returns the x of least norm that minimises |A x - b|. Singular values below `threshold` times
  /// the largest count as zero.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b, double threshold) const;
  /// Returns the number of singular values above `threshold` times the largest.
  [[nodiscard]] Eigen::Index rank(double threshold) const;
};

/// Returns the singular values and vectors of a matrix. Throws RecoverableError for one that is not
/// finite.
[[nodiscard]] SingularSystem singular_system(const Eigen::MatrixXd& matrix);

/// Factors of a square matrix by elimination with full pivoting.
class DenseLu {
 public:
  DenseLu();
  ~DenseLu();
  DenseLu(DenseLu&&) noexcept;
  DenseLu& operator=(DenseLu&&) noexcept;

  /// Factorises a matrix, which may have no rows. Returns false when a pivot vanishes.
  /// Throws RecoverableError for a matrix that is not finite.
  [[nodiscard]] bool factorise(const Eigen::MatrixXd& matrix);
  /// Returns A^-1 b.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace vesica::linalg
