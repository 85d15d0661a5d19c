#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::minimise {

/// What is looked at in a mesh whose nodes move.
struct MeshCondition {
  double quality = 0;        ///< (3.5)
  double area_ratio = 1;     ///< largest element over smallest
  double normal_cosine = 1;  ///< smallest between neighbouring sub-triangles; negative: folded
};

[[nodiscard]] MeshCondition mesh_condition(const mesh::Surface& surface);
/// "quality 0.043, area ratio 310, smallest normal cosine -0.21".
[[nodiscard]] std::string describe(const MeshCondition& condition);

/// Nodal fields after the nodes were moved along their surface.
struct MovedNodes {
  mesh::Positions positions;
  Eigen::VectorXd order_parameter;
};

/// Watches the mesh of a minimisation and moves its nodes along the surface when they have come too
/// close together or too far apart. What the start has is never held against the mesh.
class MeshCare {
 public:
  explicit MeshCare(const mesh::Surface& start);

  /// No result may come from such a mesh: quality below 0.1, elements of very different size, or
  /// folds.
  [[nodiscard]] bool is_degenerate(const MeshCondition& condition) const;
  /// The mesh has become plainly worse since the start or the last redistribution.
  [[nodiscard]] bool is_worn(const MeshCondition& condition) const;
  /// Moves the nodes; the order parameter is carried over with the quadratic elements. What comes
  /// out is the mesh that wear is measured from, also where moving the nodes did not help.
  [[nodiscard]] MovedNodes redistribute(const mesh::Surface& surface,
                                        const Eigen::VectorXd& order_parameter);

 private:
  MeshCondition start_;
  MeshCondition fresh_;
};

}  // namespace vesica::minimise
