#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "vesica/core/parallel.hpp"
#include "vesica/fem/node_graph.hpp"

namespace vesica::fem {

/// Dense matrix of an element with `Block` unknowns a node: row i Block + r, column j Block + l.
template <int Block>
using ElementMatrix = std::array<std::array<double, 6 * Block>, 6 * Block>;

/// Writes an element matrix as blocks (column node, row node), each column by column.
template <int Block>
void store_blocks(const ElementMatrix<Block>& local, double* out) {
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t column = 0; column < Block; ++column) {
        for (std::size_t row = 0; row < Block; ++row)
          *out++ = local[i * Block + row][j * Block + column];
      }
    }
  }
}

/// Sums entries of shape (T, 6, columns), one group for each node of each triangle, over the
/// triangles around a node, always in the same order: shape (N, columns), the shape of `result`, at
/// most 64 columns.
template <class Matrix>
void gather_nodal(const NodeGraph& graph, std::span<const double> local, int threads,
                  Matrix&& result) {
  const auto columns = static_cast<std::size_t>(result.cols());
  parallel_for(graph.num_nodes(), threads, [&](int begin, int end) {
    std::array<double, 64> sum;
    for (int node = begin; node < end; ++node) {
      std::fill_n(sum.begin(), columns, 0.0);
      for (const auto code : graph.incidences(node)) {
        const auto group = local.subspan(static_cast<std::size_t>(code) * columns, columns);
        for (std::size_t k = 0; k < columns; ++k) sum[k] += group[k];
      }
      for (std::size_t k = 0; k < columns; ++k) result(node, static_cast<Eigen::Index>(k)) = sum[k];
    }
  });
}

/// Sums the stored element matrices of all triangles into a matrix from
/// `graph.block_pattern(Block)`.
template <int Block>
void gather_blocks(const NodeGraph& graph, const std::vector<double>& blocks, int threads,
                   linalg::SparseMatrix& matrix) {
  constexpr std::size_t entries = Block * Block;
  parallel_for(graph.num_nodes(), threads, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      const auto count = graph.neighbours(node).size();
      for (std::size_t q = 0; q < count; ++q) {
        std::array<double, entries> sum{};
        for (const auto code :
             graph.contributions(graph.first_pair(node) + static_cast<std::int64_t>(q))) {
          const double* block = &blocks[static_cast<std::size_t>(code) * entries];
          for (std::size_t k = 0; k < entries; ++k) sum[k] += block[k];
        }
        for (std::size_t column = 0; column < Block; ++column) {
          const auto first = static_cast<std::size_t>(node) * Block + column;
          const auto start = static_cast<std::size_t>(matrix.column_starts[first]) + q * Block;
          for (std::size_t row = 0; row < Block; ++row)
            matrix.values[start + row] = sum[column * Block + row];
        }
      }
    }
  });
}

}  // namespace vesica::fem
