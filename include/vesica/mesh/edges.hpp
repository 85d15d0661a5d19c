#pragma once

#include <array>
#include <span>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// An edge as its two corner nodes, the lower index first.
using Edge = std::array<NodeIndex, 2>;

/// A triangulation by corners whose edges have become nodes: edge `e` has mid-edge node
/// `num_vertices + e`; the corners keep their numbers.
struct QuadraticConnectivity {
  std::vector<QuadraticTriangle> triangles;
  std::vector<Edge> edges;  ///< sorted
};

/// Gives every edge of a triangulation by corners a mid-edge node. Closedness and orientation are
/// left to Triangulation. Throws ConfigError when a corner is not in [0, num_vertices).
[[nodiscard]] QuadraticConnectivity add_edge_nodes(std::span<const Corners> triangles,
                                                   NodeIndex num_vertices);

}  // namespace vesica::mesh
