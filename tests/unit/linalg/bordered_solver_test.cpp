#include "vesica/linalg/bordered_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "block_matrices.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

/// Rows and columns of the border differ, as they do for the constraints.
BorderedMatrix random_bordered_matrix(int num_columns, std::mt19937& engine) {
  BorderedMatrix matrix;
  matrix.block = random_block_matrix(4, engine);
  matrix.columns = random_matrix(matrix.block.size, num_columns, engine);
  matrix.rows = random_matrix(num_columns, matrix.block.size, engine);
  return matrix;
}

TEST(BorderedMatrix, MultipliesLikeTheDenseMatrix) {
  std::mt19937 engine(5);
  const auto matrix = random_bordered_matrix(3, engine);
  const auto x = random_vector(matrix.size(), engine);
  const Eigen::VectorXd expected = to_dense(matrix) * x;
  EXPECT_LT((matrix.multiply(x) - expected).norm(), 1e-13 * expected.norm());
}

class BorderedSolverTest : public ::testing::TestWithParam<int> {};

TEST_P(BorderedSolverTest, AgreesWithTheDenseSolution) {
  std::mt19937 engine(6);
  const auto matrix = random_bordered_matrix(GetParam(), engine);
  BorderedSolver solver(DirectSolverKind::klu, matrix, 4);
  solver.factorise(matrix);
  const auto b = random_vector(matrix.size(), engine);
  const Eigen::VectorXd expected = to_dense(matrix).partialPivLu().solve(b);
  EXPECT_LT((solver.solve(b) - expected).norm(), 1e-11 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Columns, BorderedSolverTest, ::testing::Values(0, 1, 2, 3));

TEST(BorderedSolver, TakesNewValuesInBlockAndBorder) {
  std::mt19937 engine(7);
  const auto first = random_bordered_matrix(2, engine);
  const auto second = random_bordered_matrix(2, engine);
  BorderedSolver solver(default_direct_solver, first, 4);
  solver.factorise(first);
  solver.factorise(second);
  const auto b = random_vector(second.size(), engine);
  EXPECT_LT((second.multiply(solver.solve(b)) - b).norm(), 1e-11 * b.norm());
}

TEST(BorderedSolver, AsksForASmallerStepWhenARowIsZero) {
  std::mt19937 engine(8);
  auto matrix = random_bordered_matrix(2, engine);
  matrix.rows.row(1).setZero();
  BorderedSolver solver(DirectSolverKind::klu, matrix, 4);
  EXPECT_THROW(solver.factorise(matrix), RecoverableError);
}

TEST(BorderedSolver, AsksForASmallerStepWhenTheBlockIsSingular) {
  std::mt19937 engine(9);
  auto matrix = random_bordered_matrix(1, engine);
  BorderedSolver solver(DirectSolverKind::klu, matrix, 4);
  std::fill(matrix.block.values.begin(), matrix.block.values.end(), 0.0);
  EXPECT_THROW(solver.factorise(matrix), RecoverableError);
}

}  // namespace
}  // namespace vesica::linalg
