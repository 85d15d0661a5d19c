#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "vesica/mesh/triangulation.hpp"
#include "vesica/paper/bisection.hpp"

namespace vesica::paper {

/// Distances of corners 0 and 1, 1 and 2, 2 and 0.
[[nodiscard]] std::array<double, 3> side_lengths(const mesh::Surface& surface,
                                                 const mesh::QuadraticTriangle& nodes);

/// The side at which a triangle is bisected, from corner `side` to the next.
[[nodiscard]] std::size_t refinement_side(const mesh::Surface& surface,
                                          const mesh::QuadraticTriangle& nodes);

/// The edges at which bisect() bisects.
struct BisectedEdges {
  std::vector<bool> has_node;  ///< whether a node is the mid-edge node of one, shape (N)
  int count = 0;
};

/// The refinement sides of the marked triangles and, as long as there is one, that of every
/// triangle with a bisected side. Ends for any choice of refinement sides, since edges are finite.
[[nodiscard]] BisectedEdges bisected_edges(const mesh::Surface& surface,
                                           std::span<const Mark> marks);

}  // namespace vesica::paper
