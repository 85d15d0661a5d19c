#pragma once

#include <Eigen/Core>
#include <vector>

#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// A plane through `origin` that is spanned by two orthogonal unit vectors.
struct ProfilePlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [length]
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();
};

/// A point of a profile.
struct ProfilePoint {
  double along = 0;            ///< (x - origin) . along [length]
  double across = 0;           ///< (x - origin) . across [length]
  double order_parameter = 0;  ///< 0 for a single-phase vesicle
};

/// A closed curve in which the plane cuts the surface; the last point is the first once more.
using ProfileLoop = std::vector<ProfilePoint>;

/// Returns the plane through the centroid of the surface that holds its long axis (`along`) and, of
/// the directions orthogonal to it, that of largest variance.
[[nodiscard]] ProfilePlane profile_plane(const problem::State& state);

/// Cuts the surface by the plane and returns the closed curves. Their points are corners on the
/// edges of the quadratic elements and of their sub-triangles, and, where the phases meet, points
/// with order parameter exactly 0. Empty when the plane misses the surface.
[[nodiscard]] std::vector<ProfileLoop> profile(const problem::State& state,
                                               const ProfilePlane& plane);

}  // namespace vesica::measure
