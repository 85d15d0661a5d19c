#include "node_ordering.hpp"

#include <metis.h>

#include <numeric>

#include "metis_signals.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {

namespace {

struct Graph {
  std::vector<idx_t> starts;
  std::vector<idx_t> neighbours;
};

/// Graph of the blocks; block (i, j) is present when its first entry is, which dense blocks
/// guarantee.
Graph block_graph(const SparseMatrix& matrix, SparseIndex block) {
  Graph graph;
  graph.starts.push_back(0);
  for (SparseIndex column = 0; column < matrix.size; column += block) {
    const auto begin =
        static_cast<std::size_t>(matrix.column_starts[static_cast<std::size_t>(column)]);
    const auto end =
        static_cast<std::size_t>(matrix.column_starts[static_cast<std::size_t>(column) + 1]);
    for (auto k = begin; k < end; ++k) {
      const SparseIndex row = matrix.rows[k];
      if (row % block == 0 && row != column)
        graph.neighbours.push_back(static_cast<idx_t>(row / block));
    }
    graph.starts.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace

std::vector<SparseIndex> node_ordering(const SparseMatrix& matrix, int block_size) {
  Graph graph = block_graph(matrix, block_size);
  auto count = static_cast<idx_t>(graph.starts.size() - 1);
  std::vector<idx_t> permutation(graph.starts.size());
  std::vector<idx_t> inverse(graph.starts.size());
  const SignalsHeldFromMetis held;
  if (METIS_NodeND(&count, graph.starts.data(), graph.neighbours.data(), nullptr, nullptr,
                   permutation.data(), inverse.data()) != METIS_OK) {
    throw SolverError("METIS_NodeND: cannot order the nodes");
  }
  std::vector<SparseIndex> order;
  order.reserve(static_cast<std::size_t>(matrix.size));
  for (idx_t i = 0; i < count; ++i) {
    for (SparseIndex k = 0; k < block_size; ++k) {
      order.push_back(
          static_cast<SparseIndex>(permutation[static_cast<std::size_t>(i)]) * block_size + k);
    }
  }
  return order;
}

}  // namespace vesica::linalg
