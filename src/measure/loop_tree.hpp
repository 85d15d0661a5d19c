#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flat_triangulation.hpp"

namespace vesica::measure {

/// Shortest paths along edges from one node to all others.
struct PathTree {
  std::vector<double> distance;         ///< [length]; infinite for nodes of other components
  std::vector<mesh::NodeIndex> parent;  ///< -1 for the first node
  std::vector<std::int32_t> edge_of;    ///< to the parent
};

/// Edges at each node.
class NodeEdges {
 public:
  explicit NodeEdges(const FlatTriangulation& flat, mesh::NodeIndex num_nodes);
  [[nodiscard]] std::span<const std::int32_t> operator[](mesh::NodeIndex node) const {
    const auto i = static_cast<std::size_t>(node);
    return std::span(edges_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<std::int32_t> edges_;
};

[[nodiscard]] PathTree shortest_paths(const FlatTriangulation& flat, const NodeEdges& edges_at,
                                      const mesh::Positions& positions, mesh::NodeIndex first);

/// What is on the far side of the loop that an edge outside of the tree makes with the tree.
struct FarSides {
  double whole_area = 0;            ///< of the component [length^2]
  std::vector<bool> cuts;           ///< the edge's loop cuts the surface in two
  std::vector<double> area;         ///< of an edge that cuts: on its far side [length^2]
  std::vector<std::int32_t> top;    ///< of an edge that cuts: first triangle on its far side
  std::vector<std::int32_t> order;  ///< triangles by depth first; a far side is consecutive in it
  std::vector<std::int32_t> place;  ///< of a triangle in `order`
  std::vector<std::int32_t> count;  ///< triangles on the far side that begins with a triangle
};

/// The triangles and the edges outside of the tree form a graph; an edge without which it falls
/// apart is one whose loop cuts the surface (tree-cotree; Tarjan's bridges). On a sphere that is
/// every edge.
[[nodiscard]] FarSides far_sides(const FlatTriangulation& flat, const std::vector<double>& areas,
                                 const PathTree& tree, std::int32_t first_triangle);

}  // namespace vesica::measure
