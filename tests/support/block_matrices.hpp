#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "relaxation_cases.hpp"
#include "vesica/fem/node_graph.hpp"
#include "vesica/linalg/bordered_solver.hpp"

namespace vesica::linalg {

inline double random_number(std::mt19937& engine) {
  return std::uniform_real_distribution<double>(-1, 1)(engine);
}

inline Eigen::VectorXd random_vector(Eigen::Index size, std::mt19937& engine) {
  return Eigen::VectorXd::NullaryExpr(size, [&] { return random_number(engine); });
}

inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns,
                                     std::mt19937& engine) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random_number(engine); });
}

/// Nonsymmetric values on the block pattern of a sphere with 162 nodes; the diagonal is raised so
/// that the matrix is well conditioned.
inline SparseMatrix random_block_matrix(int block_size, std::mt19937& engine) {
  const auto sphere = test::make_sphere(2);
  const fem::NodeGraph graph(*sphere.triangulation);
  SparseMatrix matrix = graph.block_pattern(block_size);
  for (std::size_t column = 0; column < static_cast<std::size_t>(matrix.size); ++column) {
    for (auto k = matrix.column_starts[column]; k < matrix.column_starts[column + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      const bool is_diagonal = matrix.rows[entry] == static_cast<SparseIndex>(column);
      matrix.values[entry] = random_number(engine) + (is_diagonal ? 20 : 0);
    }
  }
  return matrix;
}

inline Eigen::MatrixXd to_dense(const SparseMatrix& matrix) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
  for (Eigen::Index column = 0; column < matrix.size; ++column) {
    const auto begin = matrix.column_starts[static_cast<std::size_t>(column)];
    const auto end = matrix.column_starts[static_cast<std::size_t>(column) + 1];
    for (auto k = begin; k < end; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      dense(matrix.rows[entry], column) += matrix.values[entry];
    }
  }
  return dense;
}

inline Eigen::MatrixXd to_dense(const BorderedMatrix& matrix) {
  const auto n = matrix.columns.rows();
  const auto m = matrix.columns.cols();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n + m, n + m);
  dense.topLeftCorner(n, n) = to_dense(matrix.block);
  dense.topRightCorner(n, m) = matrix.columns;
  dense.bottomLeftCorner(m, n) = matrix.rows;
  return dense;
}

}  // namespace vesica::linalg
