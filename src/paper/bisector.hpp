#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "bisected_edges.hpp"
#include "vesica/mesh/edges.hpp"
#include "vesica/paper/bisection.hpp"

namespace vesica::paper {

/// Builds the list of triangles and nodes that bisect() returns, old triangle by old triangle.
/// Nodes of the old mesh keep their numbers until result() closes the gaps.
class Bisector {
 public:
  Bisector(const mesh::Surface& old, const BisectedEdges& edges);

  /// Adds an old triangle, bisected at its marked sides.
  void add(mesh::NodeIndex triangle);
  /// Adds the triangle that two others are merged to.
  void add_merged(const mesh::QuadraticTriangle& nodes) { triangles_.push_back(nodes); }

  [[nodiscard]] adapt::Remeshed result() const;

 private:
  /// A triangle inside an old one: corners, the newest last, where they are, and the mid-edge nodes
  /// of its sides as far as they are there (-1: to be made).
  struct Part {
    std::array<mesh::NodeIndex, 3> corners;
    std::array<Eigen::Vector2d, 3> places;
    std::array<mesh::NodeIndex, 3> middles;
  };

  void add(mesh::NodeIndex triangle, const Part& part, std::size_t first_side);
  [[nodiscard]] mesh::NodeIndex middle_of(mesh::NodeIndex triangle, const Part& part,
                                          std::size_t side);

  const mesh::Surface& old_;
  const BisectedEdges& edges_;
  std::vector<mesh::QuadraticTriangle> triangles_;
  std::vector<mesh::SurfaceLocation> new_nodes_;
  std::map<mesh::Edge, mesh::NodeIndex> new_middles_;
};

}  // namespace vesica::paper
