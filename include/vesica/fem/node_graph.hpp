#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vesica/linalg/sparse_matrix.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::fem {

/// A graph that tells which nodes share a triangle, and which local entries of which triangles meet
/// there. Assembly is a gather over it: every thread writes its own rows and the sum runs in a
/// fixed order, so results do not depend on threads.
class NodeGraph {
 public:
  explicit NodeGraph(const mesh::Triangulation& triangulation);

  [[nodiscard]] std::int32_t num_nodes() const {
    return static_cast<std::int32_t>(node_starts_.size()) - 1;
  }
  /// Returns the neighbours of a node, itself included, ascending.
  [[nodiscard]] std::span<const std::int32_t> neighbours(std::int32_t node) const;
  /// Returns the index of the first (node, neighbour) pair of a node; pairs are numbered node by
  /// node.
  [[nodiscard]] std::int64_t first_pair(std::int32_t node) const { return node_starts_[at(node)]; }
  [[nodiscard]] std::int64_t num_pairs() const { return node_starts_.back(); }

  /// Returns the triangle corners or mid-edges at a node, coded as triangle * 6 + local number.
  [[nodiscard]] std::span<const std::int32_t> incidences(std::int32_t node) const;
  /// Returns the local matrix entries of a pair (node, neighbour), coded as triangle * 36 +
  /// local(node) * 6 + local(neighbour).
  [[nodiscard]] std::span<const std::int32_t> contributions(std::int64_t pair) const;

  /// Makes the pattern of a matrix with dense blocks of `block_size` for each pair, values zero.
  [[nodiscard]] linalg::SparseMatrix block_pattern(int block_size) const;

 private:
  static std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

  std::vector<std::int64_t> node_starts_;
  std::vector<std::int32_t> neighbours_;
  std::vector<std::int64_t> incidence_starts_;
  std::vector<std::int32_t> incidences_;
  std::vector<std::int64_t> contribution_starts_;
  std::vector<std::int32_t> contributions_;
};

}  // namespace vesica::fem
