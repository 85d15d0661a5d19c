#pragma once

#include <Eigen/Core>
#include <optional>

#include "vesica/core/fields.hpp"
#include "vesica/mesh/triangulation.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::compare {

/// The rigid motion x -> rotation x + translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [length]

  /// Returns the point after the motion.
  [[nodiscard]] Eigen::Vector3d of(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  /// Returns the point that the motion takes to `point`.
  [[nodiscard]] Eigen::Vector3d inverse_of(const Eigen::Vector3d& point) const {
    return rotation.transpose() * (point - translation);
  }
  /// Returns all positions, shape (N, 3), after the motion.
  [[nodiscard]] mesh::Positions of(const mesh::Positions& positions) const;
};

/// Distances of two vesicles after the second has been moved onto the first. Lengths are over R_c =
/// sqrt((A_1 + A_2) / 8 pi). d(x) is the distance of a point to the nearest one of the other
/// surface, and c_1 - c_2 compares the order parameter there.
struct ShapeDistance {
  RigidMotion motion;    ///< moves the second surface onto the first
  double l2 = 0;         ///< sqrt((int_1 d^2 + int_2 d^2) / (A_1 + A_2)) / R_c
  double hausdorff = 0;  ///< largest d over R_c, sampled at quadrature points and nodes
  /// sqrt((int_1 + int_2) (c_1 - c_2)^2 / (A_1 + A_2)); absent unless both carry a phase field.
  std::optional<double> phase_l2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"shape_l2", "-", "distance of the surfaces in L2 over R_c"}, self.l2);
    visit(Field{"shape_hausdorff", "-", "largest distance over R_c"}, self.hausdorff);
    visit(Field{"phase_l2", "-", "distance of the order parameters in L2"}, self.phase_l2);
  }
};

/// Finds the rigid motion (no reflection) of `second` that makes the L2 distance smallest, and
/// measures the distances there. Motions that leave the shape as it is, as turning a body of
/// revolution about its axis, are chosen by the phase field. It is a local method with many starts:
/// both surfaces as they are, the nodes one onto the other when the connectivity is the same, and
/// the axes of inertia in all their orientations. A surface that was only moved is found again to
/// round-off when it has the same connectivity, else as closely as the two meshes describe the same
/// shape. Throws ConfigError when one state is single-phase and the other is not.
[[nodiscard]] ShapeDistance shape_distance(const problem::State& first,
                                           const problem::State& second);

/// Measures the distances of `first` and of `second` moved by the given `motion`.
[[nodiscard]] ShapeDistance shape_distance(const problem::State& first,
                                           const problem::State& second, const RigidMotion& motion);

}  // namespace vesica::compare
