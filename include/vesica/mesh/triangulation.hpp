#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace vesica::mesh {

using NodeIndex = std::int32_t;

/// Nodes of a quadratic triangle, counter-clockwise seen from outside (outward normal); mid-edge
/// nodes follow the corners in the order of VTK's quadratic triangle:
///
///             2
///            / \             reference coordinates (u, v):
///           5   4            0 = (0, 0), 1 = (1, 0), 2 = (0, 1)
///          /     \           3 = mid(0, 1), 4 = mid(1, 2), 5 = mid(2, 0)
///         0---3---1
using QuadraticTriangle = std::array<NodeIndex, 6>;

/// Three corners, counter-clockwise seen from outside.
using Corners = std::array<NodeIndex, 3>;

/// Node positions [length], one row a node, shape (num_nodes, 3), row-major.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Connectivity of a closed, oriented surface of six-node triangles. Immutable; knows no positions.
class Triangulation {
 public:
  /// Makes the connectivity. Throws ConfigError naming the first offending triangle or edge when a
  /// node index is out of range or unused, a triangle repeats a node, an edge has not exactly two
  /// triangles, its two triangles are oriented inconsistently or disagree on the mid-edge node, or
  /// the triangles around a vertex do not form one fan.
  Triangulation(std::vector<QuadraticTriangle> triangles, NodeIndex num_nodes);

  [[nodiscard]] NodeIndex num_nodes() const { return num_nodes_; }
  [[nodiscard]] NodeIndex num_triangles() const {
    return static_cast<NodeIndex>(triangles_.size());
  }
  [[nodiscard]] std::span<const QuadraticTriangle> triangles() const { return triangles_; }
  /// Returns the number of corner nodes (the others are mid-edge nodes, one an edge).
  [[nodiscard]] NodeIndex num_vertices() const { return num_vertices_; }
  [[nodiscard]] NodeIndex num_edges() const { return num_nodes_ - num_vertices_; }
  /// Returns the number of connected components.
  [[nodiscard]] int num_components() const { return num_components_; }
  /// Returns V - E + F = 2 (components - genus).
  [[nodiscard]] int euler_characteristic() const {
    return num_vertices_ - num_edges() + num_triangles();
  }
  /// Returns the number of handles, of all components together.
  [[nodiscard]] int genus() const { return num_components_ - euler_characteristic() / 2; }

 private:
  std::vector<QuadraticTriangle> triangles_;
  NodeIndex num_nodes_;
  NodeIndex num_vertices_ = 0;
  int num_components_ = 0;
};

/// A surface: a triangulation and the positions of its nodes.
struct Surface {
  std::shared_ptr<const Triangulation> triangulation;
  Positions positions;
};

}  // namespace vesica::mesh
