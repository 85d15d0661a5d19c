#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vesica/mesh/edges.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::adapt {

using mesh::Corners;
using mesh::NodeIndex;

/// A closed oriented triangulation by corners whose edges can be split, collapsed and flipped;
/// knows no positions. Triangles and vertices that go leave a gap in the numbering.
class EditableMesh {
 public:
  /// Takes the corners of the triangles, whose numbers must be below `num_vertices`.
  EditableMesh(std::vector<Corners> triangles, NodeIndex num_vertices);
  /// The corners of the elements; mid-edge nodes are vertices without triangles.
  explicit EditableMesh(const mesh::Triangulation& triangulation);

  /// The two triangles at an edge and the vertices opposite to it: the first triangle runs from a
  /// to b, the second from b to a.
  struct EdgeSides {
    std::array<NodeIndex, 2> triangles;
    std::array<NodeIndex, 2> opposite;
  };

  [[nodiscard]] NodeIndex num_vertices() const { return static_cast<NodeIndex>(stars_.size()); }
  [[nodiscard]] const Corners& corners(NodeIndex triangle) const {
    return triangles_[at(triangle)];
  }
  /// Triangles around a vertex, in no order; empty for a vertex that is gone.
  [[nodiscard]] std::span<const NodeIndex> star(NodeIndex vertex) const {
    return stars_[at(vertex)];
  }
  [[nodiscard]] int valence(NodeIndex vertex) const {
    return static_cast<int>(stars_[at(vertex)].size());
  }
  [[nodiscard]] std::vector<NodeIndex> neighbours(NodeIndex vertex) const;
  /// Nothing when a and b are not joined.
  [[nodiscard]] std::optional<EdgeSides> sides(NodeIndex a, NodeIndex b) const;
  /// All edges, lower vertex first.
  [[nodiscard]] std::vector<mesh::Edge> edges() const;
  /// The triangles that exist.
  [[nodiscard]] std::vector<Corners> triangles() const;

  /// Puts a new vertex on edge (a, b), joins it to the opposite vertices and returns it.
  NodeIndex split(NodeIndex a, NodeIndex b);

  /// True when a and b have no neighbours in common but the two opposite vertices, so that b can be
  /// drawn into a without changing the topology (and more than a tetrahedron is left).
  [[nodiscard]] bool can_collapse(NodeIndex a, NodeIndex b) const;
  /// Draws b into a.
  void collapse(NodeIndex a, NodeIndex b);

  /// True when the opposite vertices of (a, b) are not joined yet.
  [[nodiscard]] bool can_flip(NodeIndex a, NodeIndex b) const;
  /// Replaces the edge (a, b) by the one between its opposite vertices.
  void flip(NodeIndex a, NodeIndex b);

 private:
  static std::size_t at(NodeIndex i) { return static_cast<std::size_t>(i); }
  void add_triangle(const Corners& corners);
  void leave(NodeIndex triangle, NodeIndex vertex);
  void replace_corner(NodeIndex triangle, NodeIndex old_vertex, NodeIndex new_vertex);

  std::vector<Corners> triangles_;  ///< all corners -1 when the triangle is gone
  std::vector<std::vector<NodeIndex>> stars_;
};

}  // namespace vesica::adapt
