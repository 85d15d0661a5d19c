#include "linalg/supernodal_cholesky.hpp"

#include <gtest/gtest.h>

#include <random>

#include "block_matrices.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

/// A + A^T on the graph of a sphere, diagonally dominant.
SparseMatrix symmetric_matrix(std::mt19937& engine) {
  auto matrix = random_block_matrix(1, engine);
  const Eigen::MatrixXd dense = to_dense(matrix);
  for (std::size_t column = 0; column < static_cast<std::size_t>(matrix.size); ++column) {
    for (auto k = matrix.column_starts[column]; k < matrix.column_starts[column + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      const auto i = static_cast<Eigen::Index>(column);
      matrix.values[entry] = dense(matrix.rows[entry], i) + dense(i, matrix.rows[entry]);
    }
  }
  return matrix;
}

TEST(SupernodalCholesky, SolvesForAllColumns) {
  std::mt19937 engine(1);
  const auto matrix = symmetric_matrix(engine);
  SupernodalCholesky factors(matrix);
  SupernodalCholesky same_order(matrix, factors);
  for (auto* solver : {&factors, &same_order}) {
    solver->factorise(matrix);
    for (const Eigen::Index columns : {1, 9, 2}) {
      const Eigen::MatrixXd x = random_matrix(matrix.size, columns, engine);
      EXPECT_LE((solver->solve(to_dense(matrix) * x) - x).norm(), 1e-12 * x.norm());
    }
  }
}

TEST(SupernodalCholesky, RefusesAnIndefiniteMatrixAndGoesOnWithAnother) {
  std::mt19937 engine(1);
  const auto matrix = symmetric_matrix(engine);
  auto indefinite = matrix;
  for (auto& value : indefinite.values) value = -value;
  SupernodalCholesky factors(matrix);
  EXPECT_THROW(factors.factorise(indefinite), RecoverableError);
  factors.factorise(matrix);
  const Eigen::MatrixXd x = random_matrix(matrix.size, 1, engine);
  EXPECT_LE((factors.solve(to_dense(matrix) * x) - x).norm(), 1e-12 * x.norm());
}

}  // namespace
}  // namespace vesica::linalg
