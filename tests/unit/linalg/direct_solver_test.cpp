#include "vesica/linalg/direct_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "block_matrices.hpp"
#include "linalg/node_ordering.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

std::span<const double> view(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}
std::span<double> view(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

TEST(SparseMatrix, MultipliesLikeTheDenseMatrix) {
  std::mt19937 engine(1);
  const auto matrix = random_block_matrix(5, engine);
  const auto x = random_vector(matrix.size, engine);
  Eigen::VectorXd y = random_vector(matrix.size, engine);  // what was there is overwritten
  matrix.multiply(view(x), view(y));
  EXPECT_LT((y - to_dense(matrix) * x).norm(), 1e-13 * y.norm());
}

TEST(NodeOrdering, IsAPermutationThatKeepsTheUnknownsOfANodeTogether) {
  std::mt19937 engine(2);
  const auto matrix = random_block_matrix(5, engine);
  auto order = node_ordering(matrix, 5);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i] % 5, static_cast<long>(i % 5));
  std::sort(order.begin(), order.end());
  ASSERT_EQ(static_cast<SparseIndex>(order.size()), matrix.size);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], static_cast<long>(i));
}

class DirectSolverTest : public ::testing::TestWithParam<DirectSolverKind> {
 protected:
  /// |A x - b| / |b| of the solution for a random right-hand side.
  double relative_residual(const DirectSolver& solver, const SparseMatrix& matrix) {
    const auto b = random_vector(matrix.size, engine_);
    Eigen::VectorXd x(matrix.size);
    solver.solve(view(b), view(x));
    Eigen::VectorXd product(matrix.size);
    matrix.multiply(view(x), view(product));
    return (product - b).norm() / b.norm();
  }

  std::mt19937 engine_{3};
};

TEST_P(DirectSolverTest, SolvesANonsymmetricBlockSystemToRoundOff) {
  for (const int block_size : {4, 5}) {
    const auto matrix = random_block_matrix(block_size, engine_);
    const auto solver = make_direct_solver(GetParam(), matrix, block_size);
    solver->factorise(matrix);
    EXPECT_LT(relative_residual(*solver, matrix), 1e-12);
  }
}

TEST_P(DirectSolverTest, TakesNewValuesInTheSamePattern) {
  auto matrix = random_block_matrix(5, engine_);
  const auto solver = make_direct_solver(GetParam(), matrix, 5);
  solver->factorise(matrix);
  matrix.values = random_block_matrix(5, engine_).values;
  EXPECT_GT(relative_residual(*solver, matrix), 1e-2);  // still the factors of the old values
  solver->factorise(matrix);
  EXPECT_LT(relative_residual(*solver, matrix), 1e-12);
}

TEST_P(DirectSolverTest, KeepsItsFactorsWhenTheMatrixIsGone) {
  auto matrix = random_block_matrix(5, engine_);
  const auto copy = matrix;
  const auto solver = make_direct_solver(GetParam(), matrix, 5);
  solver->factorise(matrix);
  matrix = {};
  EXPECT_LT(relative_residual(*solver, copy), 1e-12);
}

TEST_P(DirectSolverTest, AsksForASmallerStepWhenTheMatrixIsSingular) {
  const auto regular = random_block_matrix(5, engine_);
  auto singular = regular;
  const auto begin = singular.values.begin() + singular.column_starts[7];
  std::fill(begin, singular.values.begin() + singular.column_starts[8], 0.0);
  const auto solver = make_direct_solver(GetParam(), regular, 5);
  EXPECT_THROW(solver->factorise(singular), RecoverableError);
  solver->factorise(regular);  // and is of use afterwards
  EXPECT_LT(relative_residual(*solver, regular), 1e-12);
}

TEST_P(DirectSolverTest, AsksForASmallerStepWhenTheMatrixHoldsANaN) {
  auto matrix = random_block_matrix(5, engine_);
  const auto solver = make_direct_solver(GetParam(), matrix, 5);
  matrix.values[matrix.values.size() / 2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solver->factorise(matrix), RecoverableError);
}

std::string name_of_kind(const ::testing::TestParamInfo<DirectSolverKind>& info) {
  return std::string(name_of(info.param));
}

#ifdef VESICA_WITHOUT_UMFPACK
INSTANTIATE_TEST_SUITE_P(Kinds, DirectSolverTest, ::testing::Values(DirectSolverKind::klu),
                         name_of_kind);

TEST(DirectSolver, IsRefusedWhenThisBuildLeavesItOut) {
  std::mt19937 engine(4);
  EXPECT_THROW(
      (void)make_direct_solver(DirectSolverKind::umfpack, random_block_matrix(5, engine), 5),
      ConfigError);
}
#else
INSTANTIATE_TEST_SUITE_P(Kinds, DirectSolverTest,
                         ::testing::Values(DirectSolverKind::umfpack, DirectSolverKind::klu),
                         name_of_kind);
#endif

#ifndef VESICA_WITHOUT_MUMPS
INSTANTIATE_TEST_SUITE_P(Mumps, DirectSolverTest, ::testing::Values(DirectSolverKind::mumps),
                         name_of_kind);

/// Values of any size: single precision ends at 1e38, and its smallest numbers are lost.
TEST(MumpsSolver, PreconditionsToFiveDigitsInAnyUnit) {
  std::mt19937 engine(6);
  for (const double unit : {1e-60, 1.0, 1e60}) {
    auto matrix = random_block_matrix(5, engine);
    for (double& value : matrix.values) value *= unit;
    const auto solver = make_direct_solver(DirectSolverKind::mumps, matrix, 5);
    solver->factorise(matrix);
    const Eigen::VectorXd b = 1e50 * random_vector(matrix.size, engine);
    Eigen::VectorXd x(matrix.size);
    Eigen::VectorXd product(matrix.size);
    solver->precondition(view(b), view(x));
    matrix.multiply(view(x), view(product));
    EXPECT_LT((product - b).norm(), 1e-5 * b.norm());
    EXPECT_GT((product - b).norm(), 1e-12 * b.norm());  // single precision, as promised
  }
}
#endif

}  // namespace
}  // namespace vesica::linalg
