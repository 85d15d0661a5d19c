#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "vesica/mesh/edges.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::test {

/// Octahedron with nodes +x, -x, +y, -y, +z, -z, outward orientation.
inline std::vector<mesh::Corners> octahedron_triangles() {
  return {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
}

inline mesh::Positions octahedron_vertices() {
  mesh::Positions vertices(6, 3);
  vertices << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  return vertices;
}

/// Triangulation of the corners with a node for each edge.
inline mesh::Triangulation with_edge_nodes(const std::vector<mesh::Corners>& triangles,
                                           mesh::NodeIndex num_vertices) {
  auto connectivity = mesh::add_edge_nodes(triangles, num_vertices);
  const auto num_edges = static_cast<mesh::NodeIndex>(connectivity.edges.size());
  return {std::move(connectivity.triangles), num_vertices + num_edges};
}

/// Flat-sided surface: mid-edge nodes in the middle of the chords.
inline mesh::Surface flat_surface(const std::vector<mesh::Corners>& triangles,
                                  const mesh::Positions& vertices) {
  const auto num_vertices = static_cast<mesh::NodeIndex>(vertices.rows());
  auto connectivity = mesh::add_edge_nodes(triangles, num_vertices);
  const auto num_nodes = num_vertices + static_cast<mesh::NodeIndex>(connectivity.edges.size());
  mesh::Positions positions(num_nodes, 3);
  positions.topRows(num_vertices) = vertices;
  Eigen::Index row = num_vertices;
  for (const auto& [a, b] : connectivity.edges) {
    positions.row(row++) = 0.5 * (vertices.row(a) + vertices.row(b));
  }
  return {std::make_shared<const mesh::Triangulation>(std::move(connectivity.triangles), num_nodes),
          std::move(positions)};
}

inline mesh::Surface octahedron() {
  return flat_surface(octahedron_triangles(), octahedron_vertices());
}

}  // namespace vesica::test
