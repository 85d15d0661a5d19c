#include "side_normals.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "vesica/mesh/local_nodes.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::mesh {
namespace {

Eigen::Vector3d unit_normal(const QuadraticTriangle& nodes, std::size_t i,
                            const Positions& positions) {
  return area_vector(sub_triangle(nodes, sub_triangles[i], positions)).normalized();
}

/// -1 when one of the normals is 0.
double cosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.isZero(0) || b.isZero(0) ? -1.0 : a.dot(b);
}

}  // namespace

std::vector<SideNormal> sorted_side_normals(const Triangulation& triangulation,
                                            const Positions& positions) {
  std::vector<SideNormal> sides;
  sides.reserve(6 * triangulation.triangles().size());
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d normal = unit_normal(nodes, i, positions);
      const std::size_t next = (i + 1) % 3;
      const std::size_t last = (i + 2) % 3;
      sides.push_back({nodes[i], nodes[3 + i], nodes[next], normal});
      sides.push_back({nodes[i], nodes[3 + last], nodes[last], normal});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const SideNormal& a, const SideNormal& b) {
    return std::pair(a.corner, a.middle) < std::pair(b.corner, b.middle);
  });
  return sides;
}

double smallest_normal_cosine(const Triangulation& triangulation, const Positions& positions) {
  double smallest = 1;
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    const Eigen::Vector3d middle = unit_normal(nodes, 3, positions);
    for (std::size_t i = 0; i < 3; ++i) {
      smallest = std::min(smallest, cosine(middle, unit_normal(nodes, i, positions)));
    }
  }
  const std::vector<SideNormal> sides = sorted_side_normals(triangulation, positions);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    smallest = std::min(smallest, cosine(sides[i].normal, sides[i + 1].normal));
  }
  return smallest;
}

}  // namespace vesica::mesh
