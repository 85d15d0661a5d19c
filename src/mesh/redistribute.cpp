#include "vesica/mesh/redistribute.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "vertex_stars.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/local_nodes.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::mesh {
namespace {

using Eigen::Vector3d;

/// Moves below this part of an edge are not worth their price.
constexpr double smallest_relative_move = 2e-3;

/// Quality above this may be given up for equal sizes.
constexpr double good_quality = 0.5;

constexpr int num_angle_sweeps = 4;

/// Equal areas alone leave angles bad, centroids alone leave areas unequal where valences differ
/// (on the paper's cigar by a factor of 4, with this share by 1.3).
constexpr double area_share = 0.7;

using LocalTriangle = std::array<std::size_t, 3>;
constexpr std::array<LocalTriangle, 1> corner_triangle = {{{0, 1, 2}}};

void check_sizes(const Eigen::VectorXd& sizes, NodeIndex num_nodes) {
  if (sizes.size() == 0) return;
  if (sizes.size() != num_nodes) {
    throw ConfigError(fmt::format("redistribute: {} sizes: must be one for each of the {} nodes",
                                  sizes.size(), num_nodes));
  }
  for (Eigen::Index node = 0; node < sizes.size(); ++node) {
    if (!(sizes[node] > 0)) {
      throw ConfigError(
          fmt::format("redistribute: size {} at node {}: must be > 0", sizes[node], node));
    }
  }
}

/// Two kinds of moves: of the vertices of the flat triangles alone, and with the mid-edge nodes.
class Redistributor {
 public:
  Redistributor(const Surface& surface, const Eigen::VectorXd& sizes)
      : triangulation_(*surface.triangulation),
        locator_(surface.triangulation, surface.positions),
        stars_(triangulation_),
        old_sizes_(sizes),
        sizes_(sizes),
        now_{surface.positions, {}} {
    now_.origins.resize(static_cast<std::size_t>(triangulation_.num_nodes()));
    for (NodeIndex t = 0; t < triangulation_.num_triangles(); ++t) {
      for (std::size_t i = 0; i < 6; ++i) {
        const auto [u, v] = node_parameters[i];
        const NodeIndex node = triangle(t)[i];
        origin(node) = {t, u, v, surface.positions.row(node), 0};
      }
    }
  }

  [[nodiscard]] const Redistribution& now() const { return now_; }

  /// Moves vertices to where the areas of their flat triangles are alike; leaves mid-edge nodes
  /// behind.
  void equalise() {
    for_each_vertex([&](NodeIndex node, std::span<const NodeIndex> star) {
      const Vector3d target =
          area_share * equal_areas(node, star) + (1 - area_share) * centroid_of(star);
      move_towards(node, star, target, corner_triangle, good_quality);
    });
  }

  /// Puts all mid-edge nodes at the closest points to the middles of their chords.
  void place_edge_nodes() {
    for (const QuadraticTriangle& nodes : triangulation_.triangles()) {
      for (std::size_t side = 0; side < 3; ++side) place_edge_node(nodes, side);
    }
  }

  /// Moves vertices with bad triangles, and their mid-edge nodes, to where their angles are best.
  void improve_angles() {
    for_each_vertex([&](NodeIndex node, std::span<const NodeIndex> star) {
      if (worst_quality(star, sub_triangles) > good_quality) return;
      move_towards(node, star, apex_of(node, star), sub_triangles, 1);
    });
  }

 private:
  const QuadraticTriangle& triangle(NodeIndex t) const {
    return triangulation_.triangles()[static_cast<std::size_t>(t)];
  }
  SurfaceLocation& origin(NodeIndex node) { return now_.origins[static_cast<std::size_t>(node)]; }
  Vector3d position(NodeIndex node) const { return now_.positions.row(node); }

  template <class Visit>
  void for_each_vertex(Visit visit) {
    for (NodeIndex node = 0; node < triangulation_.num_nodes(); ++node) {
      if (!stars_[node].empty()) visit(node, stars_[node]);
    }
  }

  void place(NodeIndex node, const SurfaceLocation& location) {
    origin(node) = location;
    now_.positions.row(node) = location.point.transpose();
    if (sizes_.size() > 0) sizes_[node] = locator_.interpolate(location, old_sizes_).value();
  }

  void place_edge_node(const QuadraticTriangle& nodes, std::size_t side) {
    const NodeIndex corner = nodes[side];
    const Vector3d middle = 0.5 * (position(corner) + position(nodes[(side + 1) % 3]));
    place(nodes[3 + side], locator_.closest_from(origin(corner), middle));
  }

  /// 1 / size^4 of a triangle: the weight of its squared area.
  double density(const QuadraticTriangle& nodes) const {
    if (sizes_.size() == 0) return 1;
    return std::pow((sizes_[nodes[0]] + sizes_[nodes[1]] + sizes_[nodes[2]]) / 3, -4);
  }

  /// Where the sum of area^2 / size^4 over the flat triangles, seen along the normal, is smallest.
  Vector3d equal_areas(NodeIndex node, std::span<const NodeIndex> star) const {
    const Vector3d normal = locator_.normal(now_.origins[static_cast<std::size_t>(node)]);
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Vector3d gradient = Vector3d::Zero();
    for (const NodeIndex t : star) {
      const std::size_t i = local_number(t, node);
      const auto corners = sub_triangle(triangle(t), {i, (i + 1) % 3, (i + 2) % 3}, now_.positions);
      const Vector3d change = normal.cross(corners[2] - corners[1]);
      const double weight = density(triangle(t));
      hessian += weight * change * change.transpose();
      gradient += weight * area_vector(corners).dot(normal) * change;
    }
    hessian += hessian.trace() * normal * normal.transpose();
    return position(node) - hessian.inverse() * gradient;
  }

  /// Mean of the centroids of the flat triangles, with weights area / size^4.
  Vector3d centroid_of(std::span<const NodeIndex> star) const {
    Vector3d sum = Vector3d::Zero();
    double weights = 0;
    for (const NodeIndex t : star) {
      const auto corners = sub_triangle(triangle(t), corner_triangle[0], now_.positions);
      const double weight = area_vector(corners).norm() * density(triangle(t));
      sum += weight / 3 * (corners[0] + corners[1] + corners[2]);
      weights += weight;
    }
    return sum / weights;
  }

  /// Mean of the places where the vertex makes the flat triangles equilateral over the side
  /// opposite to it; bad triangles count more.
  Vector3d apex_of(NodeIndex node, std::span<const NodeIndex> star) const {
    Vector3d sum = Vector3d::Zero();
    double weights = 0;
    for (const NodeIndex t : star) {
      const std::size_t i = local_number(t, node);
      const auto corners = sub_triangle(triangle(t), {i, (i + 1) % 3, (i + 2) % 3}, now_.positions);
      const Vector3d side = corners[2] - corners[1];
      const Vector3d upwards = area_vector(corners).cross(side).normalized();
      const double weight = 1 / std::max(smallest_sine(corners), 1e-3);
      sum += weight * (0.5 * (corners[1] + corners[2]) + std::sqrt(0.75) * side.norm() * upwards);
      weights += weight;
    }
    return sum / weights;
  }

  std::size_t local_number(NodeIndex t, NodeIndex node) const {
    const QuadraticTriangle& nodes = triangle(t);
    return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
  }

  double worst_quality(std::span<const NodeIndex> star,
                       std::span<const LocalTriangle> parts) const {
    double worst = 1;
    for (const NodeIndex t : star) {
      for (const LocalTriangle& part : parts) {
        worst = std::min(worst, smallest_sine(sub_triangle(triangle(t), part, now_.positions)));
      }
    }
    return worst;
  }

  /// Each part looks to the outer side of the surface at its three nodes.
  bool has_no_fold(std::span<const NodeIndex> star, std::span<const LocalTriangle> parts) const {
    for (const NodeIndex t : star) {
      const QuadraticTriangle& nodes = triangle(t);
      for (const LocalTriangle& part : parts) {
        const Vector3d normal = area_vector(sub_triangle(nodes, part, now_.positions));
        for (const std::size_t i : part) {
          const SurfaceLocation& place = now_.origins[static_cast<std::size_t>(nodes[i])];
          if (normal.dot(locator_.normal(place)) <= 0) return false;
        }
      }
    }
    return true;
  }

  /// Goes the whole, half or a quarter of the way, or not at all: what keeps the lowest quality
  /// around the vertex, or keeps it at least `enough`.
  void move_towards(NodeIndex node, std::span<const NodeIndex> star, const Vector3d& target,
                    std::span<const LocalTriangle> parts, double enough) {
    const Vector3d start = position(node);
    const QuadraticTriangle& first = triangle(star.front());
    const double smallest =
        smallest_relative_move * (position(first[1]) - position(first[0])).norm();
    if ((target - start).norm() < smallest) return;
    const double needed = std::min(worst_quality(star, parts), enough);
    for (const double part : {1.0, 0.5, 0.25}) {
      const SurfaceLocation goal =
          locator_.closest_from(origin(node), start + part * (target - start));
      if ((goal.point - start).norm() < smallest) return;
      if (try_place(node, star, goal, parts, needed)) return;
    }
  }

  bool try_place(NodeIndex node, std::span<const NodeIndex> star, const SurfaceLocation& goal,
                 std::span<const LocalTriangle> parts, double needed_quality) {
    std::vector<std::pair<NodeIndex, SurfaceLocation>> saved = {{node, origin(node)}};
    place(node, goal);
    if (parts.size() > 1) {
      for (const NodeIndex t : star) {  // each edge at the vertex leaves it in exactly one triangle
        const std::size_t side = local_number(t, node);
        const NodeIndex middle = triangle(t)[3 + side];
        saved.emplace_back(middle, origin(middle));
        place_edge_node(triangle(t), side);
      }
    }
    if (worst_quality(star, parts) >= needed_quality && has_no_fold(star, parts)) return true;
    for (const auto& [moved, location] : saved) place(moved, location);
    return false;
  }

  const Triangulation& triangulation_;
  SurfaceLocator locator_;
  VertexStars stars_;
  const Eigen::VectorXd& old_sizes_;
  Eigen::VectorXd sizes_;
  Redistribution now_;
};

}  // namespace

Redistribution redistribute(const Surface& surface, int sweeps, const Eigen::VectorXd& sizes) {
  check_sizes(sizes, surface.triangulation->num_nodes());
  Redistributor redistributor(surface, sizes);
  const Redistribution old = redistributor.now();
  for (int i = 0; i < sweeps; ++i) redistributor.equalise();
  redistributor.place_edge_nodes();
  for (int i = 0; i < num_angle_sweeps; ++i) redistributor.improve_angles();
  const double before = quality(*surface.triangulation, old.positions);
  const double after = quality(*surface.triangulation, redistributor.now().positions);
  return after >= std::min(before, good_quality) ? redistributor.now() : old;
}

}  // namespace vesica::mesh
