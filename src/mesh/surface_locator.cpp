#include "vesica/mesh/surface_locator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "box_tree.hpp"
#include "curved_triangle.hpp"
#include "vertex_stars.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quadratic_shape.hpp"

namespace vesica::mesh {

std::array<double, 6> shape_weights(const SurfaceLocation& location) {
  return shape_values(location.u, location.v).value;
}

struct SurfaceLocator::Index {
  std::vector<CurvedTriangle> triangles;
  BoxTree tree;
  VertexStars stars;

  [[nodiscard]] const CurvedTriangle& triangle(NodeIndex t) const {
    return triangles[static_cast<std::size_t>(t)];
  }
};

namespace {

std::vector<CurvedTriangle> curved_triangles(const Triangulation& triangulation,
                                             const Positions& positions) {
  if (positions.rows() != triangulation.num_nodes()) {
    throw ConfigError(
        fmt::format("surface locator: {} positions: must be one for each of the {} nodes",
                    positions.rows(), triangulation.num_nodes()));
  }
  if (!positions.allFinite()) throw ConfigError("surface locator: positions: must be finite");
  std::vector<CurvedTriangle> triangles;
  triangles.reserve(triangulation.triangles().size());
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    triangles.emplace_back(nodes, positions);
  }
  return triangles;
}

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<CurvedTriangle>& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(triangles.size());
  for (const CurvedTriangle& triangle : triangles) boxes.push_back(triangle.box());
  return boxes;
}

/// Closest point among those that `accepts(triangle, parameters)` takes; nothing when it takes
/// none.
template <class Index, class Accepts>
std::optional<SurfaceLocation> search(const Index& index, const Eigen::Vector3d& point,
                                      Accepts accepts) {
  double smallest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d parameters(0, 0);
  NodeIndex found = -1;
  index.tree.search(point, [&](NodeIndex t) {
    const auto candidate = index.triangle(t).closest(point);
    if (candidate.squared_distance < smallest && accepts(t, candidate.parameters)) {
      smallest = candidate.squared_distance;
      parameters = candidate.parameters;
      found = t;
    }
    return smallest;
  });
  if (found < 0) return std::nullopt;
  return SurfaceLocation{found, parameters.x(), parameters.y(),
                         index.triangle(found).point(parameters), std::sqrt(smallest)};
}

constexpr double at_the_rim = 1e-9;
constexpr int max_walk = 100;

/// Triangles that share the corner or the side that a location lies on; none for one inside.
std::vector<NodeIndex> neighbours_at(const Triangulation& triangulation, const VertexStars& stars,
                                     const SurfaceLocation& location) {
  const std::array<double, 3> barycentric = {1 - location.u - location.v, location.u, location.v};
  const QuadraticTriangle& nodes =
      triangulation.triangles()[static_cast<std::size_t>(location.triangle)];
  std::vector<NodeIndex> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    if (barycentric[i] > at_the_rim) corners.push_back(nodes[i]);
  }
  std::vector<NodeIndex> neighbours;
  if (corners.size() == 3) return neighbours;
  for (const NodeIndex t : stars[corners.front()]) {
    const QuadraticTriangle& other = triangulation.triangles()[static_cast<std::size_t>(t)];
    const bool has_last =
        std::find(other.begin(), other.begin() + 3, corners.back()) != other.begin() + 3;
    if (t != location.triangle && has_last) neighbours.push_back(t);
  }
  return neighbours;
}

}  // namespace

SurfaceLocator::SurfaceLocator(std::shared_ptr<const Triangulation> triangulation,
                               Positions positions)
    : triangulation_(std::move(triangulation)), positions_(std::move(positions)) {
  std::vector<CurvedTriangle> triangles = curved_triangles(*triangulation_, positions_);
  BoxTree tree(boxes_of(triangles));
  index_ = std::make_shared<const Index>(
      Index{std::move(triangles), std::move(tree), VertexStars(*triangulation_)});
}

SurfaceLocation SurfaceLocator::closest(const Eigen::Vector3d& point) const {
  if (!point.allFinite()) {
    throw ConfigError(fmt::format("surface locator: point ({}, {}, {}): must be finite", point.x(),
                                  point.y(), point.z()));
  }
  return *search(*index_, point, [](NodeIndex, const Eigen::Vector2d&) { return true; });
}

SurfaceLocation SurfaceLocator::closest(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) const {
  const auto found = search(*index_, point, [&](NodeIndex t, const Eigen::Vector2d& parameters) {
    return index_->triangle(t).area_vector(parameters).dot(normal) > 0;
  });
  return found ? *found : closest(point);
}

SurfaceLocation SurfaceLocator::closest_from(const SurfaceLocation& start,
                                             const Eigen::Vector3d& point) const {
  const auto on_triangle = [&](NodeIndex t) {
    const auto found = index_->triangle(t).closest(point);
    return SurfaceLocation{t, found.parameters.x(), found.parameters.y(),
                           index_->triangle(t).point(found.parameters),
                           std::sqrt(found.squared_distance)};
  };
  SurfaceLocation best = on_triangle(start.triangle);
  for (int step = 0; step < max_walk; ++step) {
    const SurfaceLocation last = best;
    for (const NodeIndex t : neighbours_at(*triangulation_, index_->stars, last)) {
      const SurfaceLocation candidate = on_triangle(t);
      if (candidate.distance < best.distance) best = candidate;
    }
    if (best.triangle == last.triangle) break;
  }
  return best;
}

Eigen::Vector3d SurfaceLocator::normal(const SurfaceLocation& location) const {
  return index_->triangle(location.triangle).area_vector({location.u, location.v}).normalized();
}

}  // namespace vesica::mesh
