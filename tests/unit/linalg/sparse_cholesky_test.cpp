#include "vesica/linalg/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include "block_matrices.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

/// A symmetric positive definite matrix on the pattern of a sphere with 162 nodes.
SparseMatrix random_definite_matrix(std::mt19937& engine) {
  auto matrix = random_block_matrix(1, engine);
  const Eigen::MatrixXd dense = to_dense(matrix);
  for (std::size_t column = 0; column < static_cast<std::size_t>(matrix.size); ++column) {
    for (auto k = matrix.column_starts[column]; k < matrix.column_starts[column + 1]; ++k) {
      const auto row = matrix.rows[static_cast<std::size_t>(k)];
      const auto j = static_cast<Eigen::Index>(column);
      matrix.values[static_cast<std::size_t>(k)] = 0.5 * (dense(row, j) + dense(j, row));
    }
  }
  return matrix;
}

class SparseCholeskyTest : public ::testing::Test {
 protected:
  std::mt19937 engine_{4};
  SparseMatrix matrix_ = random_definite_matrix(engine_);
  Eigen::MatrixXd dense_ = to_dense(matrix_);
  Eigen::VectorXd x_ = random_vector(matrix_.size, engine_);
  SparseCholesky cholesky_{matrix_};
};

TEST_F(SparseCholeskyTest, SolvesToRoundOff) {
  cholesky_.factorise(matrix_);
  EXPECT_LT((dense_ * cholesky_.solve(x_) - x_).norm(), 1e-13 * x_.norm());
}

TEST_F(SparseCholeskyTest, TheFactorTimesItsTransposeIsTheMatrix) {
  cholesky_.factorise(matrix_);
  const Eigen::VectorXd product = cholesky_.multiply(cholesky_.multiply_transposed(x_));
  EXPECT_LT((product - dense_ * x_).norm(), 1e-13 * product.norm());
}

TEST_F(SparseCholeskyTest, SolvesWithTheFactorUndoTheProductsWithIt) {
  cholesky_.factorise(matrix_);
  EXPECT_LT((cholesky_.solve_factor(cholesky_.multiply(x_)) - x_).norm(), 1e-13 * x_.norm());
  EXPECT_LT((cholesky_.solve_transposed(cholesky_.multiply_transposed(x_)) - x_).norm(),
            1e-13 * x_.norm());
}

TEST_F(SparseCholeskyTest, TheFactorMakesTheMatrixTheIdentity) {
  cholesky_.factorise(matrix_);
  const auto y = random_vector(matrix_.size, engine_);
  const Eigen::VectorXd u = cholesky_.solve_transposed(y);
  EXPECT_NEAR(u.dot(dense_ * u), y.squaredNorm(), 1e-12 * y.squaredNorm());
}

TEST_F(SparseCholeskyTest, FactorisesANewMatrixOfTheSamePattern) {
  cholesky_.factorise(matrix_);
  auto twice = matrix_;
  for (double& value : twice.values) value *= 2;
  cholesky_.factorise(twice);
  EXPECT_LT((2 * dense_ * cholesky_.solve(x_) - x_).norm(), 1e-13 * x_.norm());
}

TEST_F(SparseCholeskyTest, RefusesAMatrixThatIsNotPositiveDefinite) {
  auto indefinite = matrix_;
  for (double& value : indefinite.values) value = -value;
  EXPECT_THROW(cholesky_.factorise(indefinite), RecoverableError);
}

}  // namespace
}  // namespace vesica::linalg
