#include "vesica/linalg/dense.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "block_matrices.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

class DenseTest : public ::testing::Test {
 protected:
  std::mt19937 engine_{1};
};

TEST_F(DenseTest, EigenvectorsAreOrthonormalAndAscend) {
  const Eigen::MatrixXd half = random_matrix(7, 7, engine_);
  const Eigen::MatrixXd matrix = half + half.transpose();
  const auto [values, vectors] = symmetric_eigensystem(matrix);
  EXPECT_LT((matrix * vectors - vectors * values.asDiagonal()).norm(), 1e-12);
  EXPECT_LT((vectors.transpose() * vectors - Eigen::MatrixXd::Identity(7, 7)).norm(), 1e-12);
  for (Eigen::Index k = 1; k < 7; ++k) EXPECT_LE(values[k - 1], values[k]);
}

TEST_F(DenseTest, SolvesLeastSquaresOfLeastNormWhereColumnsAreDependent) {
  Eigen::MatrixXd matrix = random_matrix(9, 4, engine_);
  matrix.col(3) = matrix.col(1) - 2 * matrix.col(0);
  const Eigen::VectorXd b = random_vector(9, engine_);
  const auto system = singular_system(matrix);
  EXPECT_EQ(system.rank(1e-10), 3);
  const Eigen::VectorXd x = system.solve(b, 1e-10);
  EXPECT_LT((matrix.transpose() * (matrix * x - b)).norm(), 1e-12);
  const Eigen::Vector4d null(-2, 1, 0, -1);  // matrix * null = 0
  EXPECT_NEAR(x.dot(null), 0, 1e-12);
}

TEST_F(DenseTest, FactorsSolveAndTellOfAVanishingPivot) {
  const Eigen::MatrixXd matrix = random_matrix(5, 5, engine_);
  const Eigen::VectorXd b = random_vector(5, engine_);
  DenseLu lu;
  ASSERT_TRUE(lu.factorise(matrix));
  EXPECT_LT((matrix * lu.solve(b) - b).norm(), 1e-12);
  EXPECT_FALSE(lu.factorise(Eigen::MatrixXd::Zero(2, 2)));
  EXPECT_TRUE(lu.factorise(Eigen::MatrixXd(0, 0)));
  EXPECT_EQ(lu.solve(Eigen::VectorXd(0)).size(), 0);
}

TEST_F(DenseTest, RefusesNumbersThatAreNone) {
  Eigen::MatrixXd matrix = random_matrix(3, 3, engine_);
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)singular_system(matrix), RecoverableError);
  EXPECT_THROW((void)DenseLu().factorise(matrix), RecoverableError);
  EXPECT_FALSE(symmetric_eigensystem(matrix).values.allFinite());
}

}  // namespace
}  // namespace vesica::linalg
