#include "vesica/measure/self_intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "mesh/box_tree.hpp"
#include "vesica/mesh/local_nodes.hpp"

namespace vesica::measure {
namespace {

using FlatTriangle = std::array<Eigen::Vector3d, 3>;

/// Six times the volume of a tetrahedron; positive when d is below the triangle a, b, c.
double orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d) {
  return (a - d).dot((b - d).cross(c - d));
}

std::optional<Eigen::Vector3d> cut(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                   const FlatTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  const double below = orientation(a, b, c, from);
  const double above = orientation(a, b, c, to);
  if (below * above >= 0) return std::nullopt;
  const double ab = orientation(from, to, a, b);
  const double bc = orientation(from, to, b, c);
  const double ca = orientation(from, to, c, a);
  const bool is_inside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  if (!is_inside) return std::nullopt;
  return from + below / (below - above) * (to - from);
}

std::optional<Eigen::Vector3d> common_point(const FlatTriangle& first, const FlatTriangle& second) {
  for (const auto& [sides, plane] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    for (std::size_t i = 0; i < 3; ++i)
      if (auto point = cut((*sides)[i], (*sides)[(i + 1) % 3], *plane)) return point;
  }
  return std::nullopt;
}

Eigen::AlignedBox3d box_of(const FlatTriangle& triangle) {
  Eigen::AlignedBox3d box(triangle[0]);
  return box.extend(triangle[1]).extend(triangle[2]);
}

std::optional<Eigen::Vector3d> common_point(const mesh::QuadraticTriangle& first,
                                            const mesh::QuadraticTriangle& second,
                                            const mesh::Positions& positions) {
  for (const auto& local : mesh::sub_triangles) {
    const FlatTriangle a = mesh::sub_triangle(first, local, positions);
    const Eigen::AlignedBox3d box = box_of(a);
    for (const auto& other : mesh::sub_triangles) {
      const FlatTriangle b = mesh::sub_triangle(second, other, positions);
      if (!box.intersects(box_of(b))) continue;
      if (auto point = common_point(a, b)) return point;
    }
  }
  return std::nullopt;
}

bool have_a_common_corner(const mesh::QuadraticTriangle& a, const mesh::QuadraticTriangle& b) {
  return std::find_first_of(a.begin(), a.begin() + 3, b.begin(), b.begin() + 3) != a.begin() + 3;
}

std::vector<Eigen::AlignedBox3d> boxes_of(const mesh::Surface& surface) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(surface.triangulation->triangles().size());
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    Eigen::AlignedBox3d box;
    for (const mesh::NodeIndex node : nodes)
      box.extend(Eigen::Vector3d(surface.positions.row(node)));
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

std::vector<SelfIntersection> self_intersections(const mesh::Surface& surface,
                                                 std::size_t max_pairs) {
  const auto triangles = surface.triangulation->triangles();
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_of(surface);
  const mesh::BoxTree tree(boxes);
  std::vector<SelfIntersection> found;
  for (mesh::NodeIndex first = 0; first < surface.triangulation->num_triangles(); ++first) {
    const mesh::QuadraticTriangle& nodes = triangles[static_cast<std::size_t>(first)];
    std::vector<SelfIntersection> pairs;
    tree.visit_meeting(boxes[static_cast<std::size_t>(first)], [&](mesh::NodeIndex second) {
      const mesh::QuadraticTriangle& others = triangles[static_cast<std::size_t>(second)];
      if (second <= first || have_a_common_corner(nodes, others)) return;
      if (const auto point = common_point(nodes, others, surface.positions))
        pairs.push_back({{first, second}, *point});
    });
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.triangles < b.triangles; });
    for (const SelfIntersection& pair : pairs)
      if (found.size() < max_pairs) found.push_back(pair);
    if (found.size() >= max_pairs) break;
  }
  return found;
}

}  // namespace vesica::measure
