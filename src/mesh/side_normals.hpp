#pragma once

#include <Eigen/Core>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// Half an edge of one triangle, from a corner to the mid-edge node, and the normal of the
/// sub-triangle at it: of length 1, or 0 when the sub-triangle has no area.
struct SideNormal {
  NodeIndex corner;
  NodeIndex middle;
  NodeIndex other_corner;
  Eigen::Vector3d normal;
};

/// All of a surface, sorted so that entries 2 i and 2 i + 1 are the two sides of one half edge.
[[nodiscard]] std::vector<SideNormal> sorted_side_normals(const Triangulation& triangulation,
                                                          const Positions& positions);

}  // namespace vesica::mesh
