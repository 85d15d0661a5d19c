#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::minimise {

/// Condition of a mesh whose nodes move: the numbers by which it is judged.
struct MeshCondition {
  double quality = 0;        ///< (3.5)
  double area_ratio = 1;     ///< largest element over smallest
  double normal_cosine = 1;  ///< smallest between neighbouring sub-triangles; negative: folded
};

/// The best condition that a mesh can have, about.
inline constexpr MeshCondition even_mesh{1, 1, 1};

[[nodiscard]] MeshCondition mesh_condition(const mesh::Surface& surface);
/// Returns the condition as text: "quality 0.043, area ratio 310, smallest normal cosine -0.21".
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
  /// Measures wear from another condition than that of the start.
  MeshCare(const mesh::Surface& start, const MeshCondition& fresh);

  /// Tells whether a mesh is so bad that no result may come from it: quality below 0.1, elements of
  /// very different size, or folds.
  [[nodiscard]] bool is_degenerate(const MeshCondition& condition) const;
  /// Tells whether the mesh has become plainly worse since the start or the last redistribution.
  [[nodiscard]] bool is_worn(const MeshCondition& condition) const;
  /// Moves the nodes along the surface; the order parameter is interpolated with the quadratic
  /// elements. Wear is measured from the resulting mesh from then on, also where moving the nodes
  /// did not help.
  [[nodiscard]] MovedNodes redistribute(const mesh::Surface& surface,
                                        const Eigen::VectorXd& order_parameter);

 private:
  MeshCondition start_;
  MeshCondition fresh_;
};

}  // namespace vesica::minimise
