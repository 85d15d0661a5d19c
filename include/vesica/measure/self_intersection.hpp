#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::measure {

/// Two elements that cut each other, and a point that lies on both [length].
struct SelfIntersection {
  std::array<mesh::NodeIndex, 2> triangles;
  Eigen::Vector3d point;
};

/// Finds pairs of elements whose flat sub-triangles (those of (3.5)) cut each other, in the order
/// of their numbers, at most `max_pairs`. Elements with a common corner are left out, which is
/// where folds are (smallest_normal_cosine). Sub-triangles that only touch, or lie in one plane,
/// need not be found. Costs N log N.
[[nodiscard]] std::vector<SelfIntersection> self_intersections(const mesh::Surface& surface,
                                                               std::size_t max_pairs);

}  // namespace vesica::measure
