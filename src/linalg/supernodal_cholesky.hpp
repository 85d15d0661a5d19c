#pragma once

#include <Eigen/Core>
#include <memory>

#include "vesica/linalg/sparse_matrix.hpp"

namespace vesica::linalg {

/// Cholesky factors of a sparse symmetric positive definite matrix, only for solving with it:
/// dense blocks of CHOLMOD with 32-bit indices, which take half the memory and less than half the
/// time of SparseCholesky. Without CHOLMOD (VESICA_WITH_UMFPACK=OFF) those of SparseCholesky.
class SupernodalCholesky {
 public:
  /// Makes the factorisation for all matrices with the pattern of `pattern`, which is analysed
  /// once; its values do not matter.
  explicit SupernodalCholesky(const SparseMatrix& pattern);
  /// The same with the ordering that was found for another matrix of this pattern.
  SupernodalCholesky(const SparseMatrix& pattern, const SupernodalCholesky& ordered);
  ~SupernodalCholesky();
  SupernodalCholesky(SupernodalCholesky&&) noexcept;
  SupernodalCholesky& operator=(SupernodalCholesky&&) noexcept;

  /// Computes the factors; reads the lower triangle. Throws RecoverableError when the matrix is not
  /// positive definite.
  void factorise(const SparseMatrix& matrix);
  /// Returns A^-1 b for all columns of b at once.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace vesica::linalg
