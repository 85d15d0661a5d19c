#include "vesica/measure/neck.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "flat_triangulation.hpp"
#include "loop_tree.hpp"
#include "plane_curve.hpp"
#include "vesica/mesh/local_nodes.hpp"

namespace vesica::measure {
namespace {

constexpr std::size_t max_places = 6;
constexpr double bent_enough = 0.7;       // curvature in an element against that of the circle
constexpr double edge_path_excess = 1.2;  // of curves along edges

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Largest angle over distance between the middle sub-triangle of an element and another one.
double curvature_in(const mesh::QuadraticTriangle& nodes, const mesh::Positions& positions) {
  const auto middle = mesh::sub_triangle(nodes, mesh::sub_triangles[3], positions);
  const Eigen::Vector3d normal = mesh::area_vector(middle);
  const Eigen::Vector3d centre = (middle[0] + middle[1] + middle[2]) / 3;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corner = mesh::sub_triangle(nodes, mesh::sub_triangles[i], positions);
    const Eigen::Vector3d other = mesh::area_vector(corner);
    const double angle = std::atan2(normal.cross(other).norm(), normal.dot(other));
    const double distance = ((corner[0] + corner[1] + corner[2]) / 3 - centre).norm();
    largest = std::max(largest, angle / distance);
  }
  return largest;
}

/// Mid-edge nodes of the most strongly curved elements, apart from each other.
std::vector<mesh::NodeIndex> curved_places(const mesh::Surface& surface, double longest) {
  const double smallest = bent_enough * 2 * std::numbers::pi / longest;
  std::vector<std::pair<double, mesh::NodeIndex>> elements;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    const double curvature = curvature_in(nodes, surface.positions);
    if (curvature >= smallest) elements.emplace_back(curvature, nodes[3]);
  }
  std::sort(elements.rbegin(), elements.rend());
  std::vector<mesh::NodeIndex> places;
  for (const auto& [curvature, node] : elements) {
    const bool is_near = std::any_of(places.begin(), places.end(), [&, node = node](auto place) {
      return (surface.positions.row(place) - surface.positions.row(node)).norm() < longest / 4;
    });
    if (!is_near) places.push_back(node);
    if (places.size() == max_places) break;
  }
  return places;
}

/// Closed curves along the edges of sub-triangles.
class LoopSearch {
 public:
  explicit LoopSearch(const mesh::Surface& surface)
      : surface_(surface),
        flat_(flat_triangulation(*surface.triangulation)),
        edges_at_(flat_, surface.triangulation->num_nodes()),
        areas_(areas_of(flat_, surface.positions)) {}

  /// The shortest neck among the loops through a node.
  [[nodiscard]] std::optional<Neck> neck_through(mesh::NodeIndex node, double longest) const {
    const PathTree tree = shortest_paths(flat_, edges_at_, surface_.positions, node);
    const std::int32_t triangle = flat_.edges[index(edges_at_[node].front())].triangles[0];
    const FarSides sides = far_sides(flat_, areas_, tree, triangle);
    double shortest = edge_path_excess * longest;
    std::int32_t best = -1;
    for (std::size_t e = 0; e < flat_.edges.size(); ++e) {
      const double length = length_through(tree, e);
      if (length >= shortest || is_in_tree(tree, static_cast<std::int32_t>(e))) continue;
      if (!is_neck(sides, e, length)) continue;
      shortest = length;
      best = static_cast<std::int32_t>(e);
    }
    if (best < 0) return std::nullopt;
    return described(tree, sides, best, shortest);
  }

 private:
  /// A loop that the paths to both ends leave together is left to a place nearer to it.
  [[nodiscard]] double length_through(const PathTree& tree, std::size_t e) const {
    const auto& edge = flat_.edges[e];
    return tree.distance[index(edge.from)] + tree.distance[index(edge.to)] +
           (surface_.positions.row(edge.from) - surface_.positions.row(edge.to)).norm();
  }
  [[nodiscard]] bool is_in_tree(const PathTree& tree, std::int32_t e) const {
    const auto& edge = flat_.edges[index(e)];
    return tree.edge_of[index(edge.from)] == e || tree.edge_of[index(edge.to)] == e;
  }
  [[nodiscard]] static bool is_neck(const FarSides& sides, std::size_t e, double length) {
    if (!sides.cuts[e]) return true;
    const double smaller = std::min(sides.area[e], sides.whole_area - sides.area[e]);
    return smaller > neck_area_ratio * length * length;
  }

  [[nodiscard]] std::vector<mesh::NodeIndex> nodes_of(const PathTree& tree, std::int32_t e) const {
    const auto path = [&](mesh::NodeIndex node) {
      std::vector<mesh::NodeIndex> nodes;
      for (; node >= 0; node = tree.parent[index(node)]) nodes.push_back(node);
      return nodes;
    };
    std::vector<mesh::NodeIndex> there = path(flat_.edges[index(e)].from);
    std::vector<mesh::NodeIndex> back = path(flat_.edges[index(e)].to);
    while (there.size() > 1 && back.size() > 1 &&
           there[there.size() - 2] == back[back.size() - 2]) {
      there.pop_back();
      back.pop_back();
    }
    back.pop_back();
    there.insert(there.end(), back.rbegin(), back.rend());
    return there;
  }

  [[nodiscard]] Neck described(const PathTree& tree, const FarSides& sides, std::int32_t e,
                               double length) const {
    const std::vector<mesh::NodeIndex> nodes = nodes_of(tree, e);
    Neck neck;
    neck.length = length;
    for (const mesh::NodeIndex node : nodes)
      neck.centre += surface_.positions.row(node).transpose();
    neck.centre /= static_cast<double>(nodes.size());
    std::vector<mesh::NodeIndex> nearby;
    for (mesh::NodeIndex node = 0; node < surface_.triangulation->num_nodes(); ++node)
      if (tree.distance[index(node)] < 1.5 * length) nearby.push_back(node);
    const auto curve = narrowest_plane_curve(flat_, edges_at_, surface_.positions, nodes, nearby);
    if (curve) {
      neck.length = curve->length;
      neck.centre = curve->centre;
    }
    neck.separates = sides.cuts[index(e)];
    neck.larger_area = sides.whole_area;
    neck.side_areas = Eigen::MatrixX2d::Zero(surface_.positions.rows(), 2);
    if (neck.separates) add_sides(sides, e, neck);
    return neck;
  }

  void add_sides(const FarSides& sides, std::int32_t e, Neck& neck) const {
    const double far = sides.area[index(e)];
    const bool far_is_smaller = 2 * far <= sides.whole_area;
    neck.smaller_area = far_is_smaller ? far : sides.whole_area - far;
    neck.larger_area = sides.whole_area - neck.smaller_area;
    const std::int32_t top = sides.top[index(e)];
    const std::int32_t begin = sides.place[index(top)];
    const std::int32_t end = begin + sides.count[index(top)];
    for (const std::int32_t triangle : sides.order) {
      const std::int32_t place = sides.place[index(triangle)];
      const bool is_far = place >= begin && place < end;
      for (const mesh::NodeIndex node : flat_.triangles[index(triangle)])
        neck.side_areas(node, is_far == far_is_smaller ? 0 : 1) += areas_[index(triangle)] / 3;
    }
  }

  const mesh::Surface& surface_;
  FlatTriangulation flat_;
  NodeEdges edges_at_;
  std::vector<double> areas_;
};

}  // namespace

std::optional<Neck> find_neck(const mesh::Surface& surface, double longest) {
  const std::vector<mesh::NodeIndex> places = curved_places(surface, longest);
  if (places.empty()) return std::nullopt;
  const LoopSearch search(surface);
  std::optional<Neck> shortest;
  for (const mesh::NodeIndex place : places) {
    auto neck = search.neck_through(place, longest);
    if (neck && neck->length <= (shortest ? shortest->length : longest)) shortest = std::move(neck);
  }
  return shortest;
}

}  // namespace vesica::measure
