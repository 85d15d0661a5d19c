#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::measure {

/// The flat sub-triangles of all elements as one triangulation whose corners are all nodes.
struct FlatTriangulation {
  struct Edge {
    mesh::NodeIndex from;
    mesh::NodeIndex to;
    std::array<std::int32_t, 2> triangles;
  };
  std::vector<mesh::Corners> triangles;  ///< four an element, in the order of `sub_triangles`
  std::vector<Edge> edges;
  std::vector<std::array<std::int32_t, 3>> edges_of;  ///< of a triangle: edges 01, 12, 20
};

[[nodiscard]] FlatTriangulation flat_triangulation(const mesh::Triangulation& triangulation);

/// Area of each triangle [length^2].
[[nodiscard]] std::vector<double> areas_of(const FlatTriangulation& flat,
                                           const mesh::Positions& positions);

}  // namespace vesica::measure
