#include "vesica/mesh/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vesica/mesh/local_nodes.hpp"
#include "volume_below.hpp"

namespace vesica::mesh {

double smallest_sine(const std::array<Eigen::Vector3d, 3>& p) {
  const std::array<double, 3> sides = {(p[1] - p[0]).norm(), (p[2] - p[1]).norm(),
                                       (p[0] - p[2]).norm()};
  const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  double smallest = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double product = sides[i] * sides[(i + 1) % 3];
    smallest = std::min(smallest, product > 0 ? twice_area / product : 0.0);
  }
  return smallest;
}

double quality(const Triangulation& triangulation, const Positions& positions) {
  double smallest = 1.0;
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    for (const auto& local : sub_triangles) {
      smallest = std::min(smallest, smallest_sine(sub_triangle(nodes, local, positions)));
    }
  }
  return smallest;
}

std::vector<double> element_areas(const Triangulation& triangulation, const Positions& positions) {
  std::vector<double> areas;
  areas.reserve(triangulation.triangles().size());
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    double area = 0;
    for (const auto& local : sub_triangles) {
      area += 0.5 * area_vector(sub_triangle(nodes, local, positions)).norm();
    }
    areas.push_back(area);
  }
  return areas;
}

double area_ratio(const Triangulation& triangulation, const Positions& positions) {
  const std::vector<double> areas = element_areas(triangulation, positions);
  const auto [smallest, largest] = std::minmax_element(areas.begin(), areas.end());
  return *smallest > 0 ? *largest / *smallest : std::numeric_limits<double>::infinity();
}

double enclosed_volume(const Triangulation& triangulation, const Positions& positions) {
  double volume = 0;
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    volume += volume_below(nodes, positions);
  }
  return volume;
}

}  // namespace vesica::mesh
