#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::measure {

/// A neck: a short closed curve on a surface with much area on both sides of it, or one that does
/// not cut the surface in two: the tube or the hole of a torus.
struct Neck {
  double length = 0;                                 ///< of the curve [length]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the curve [length]
  bool separates = true;                             ///< the curve cuts its component in two
  double smaller_area = 0;  ///< of the two sides; 0 unless it separates [length^2]
  double larger_area = 0;   ///< or of the whole component [length^2]
  /// Areas int phi_i of the smaller and the larger side that belong to each node, shape (N, 2)
  /// [length^2]; zero unless the curve separates.
  Eigen::MatrixX2d side_areas;

  /// Returns the radius length / 2 pi of the circle of the same length [length].
  [[nodiscard]] double radius() const { return length / (2 * std::numbers::pi); }
};

/// Smallest area of the smaller side, in units of l^2, for which a closed curve of length l is a
/// neck. Half a sphere has 0.16, and the cap beyond a sphere's neck of radius r has (R / r)^2 / pi:
/// 2 is R = 2.5 r. Half a tube of length L has L / (4 pi r), so one of 25 radii counts as a neck.
inline constexpr double neck_area_ratio = 2;

/// Finds the shortest neck of at most length `longest` [length]; absent when there is none. It
/// begins with closed curves along the edges of sub-triangles through the most strongly curved
/// elements, a shortest path tree and one edge more, which are up to 2 / sqrt(3) too long; then
/// planes along the curve are cut with the sub-triangles, going downhill, which is too short by the
/// chords of the mesh. Costs next to nothing on a surface that is nowhere curved with the radius
/// longest / 2 pi, else about N log N. At most six places at distances of longest / 4 are looked
/// at.
[[nodiscard]] std::optional<Neck> find_neck(const mesh::Surface& surface, double longest);

}  // namespace vesica::measure
