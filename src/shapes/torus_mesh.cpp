#include "torus_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "vesica/mesh/edges.hpp"

namespace vesica::shapes {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// Conformal coordinates of period 1: along the ring and around the tube.
struct GridPoint {
  double along;
  double around;
};

/// Rows of `num_around` vertices, every other row shifted by half an element.
class TorusGrid {
 public:
  TorusGrid(int num_rows, int num_around) : num_rows_(num_rows), num_around_(num_around) {}

  [[nodiscard]] mesh::NodeIndex num_vertices() const { return num_rows_ * num_around_; }

  [[nodiscard]] std::vector<mesh::Corners> triangles() const {
    std::vector<mesh::Corners> result;
    for (int row = 0; row < num_rows_; ++row) {
      for (int j = 0; j < num_around_; ++j) {
        const int ahead = j + row % 2;
        const mesh::NodeIndex a = vertex(row, j);
        const mesh::NodeIndex c = vertex(row + 1, ahead);
        result.push_back({a, c, vertex(row, j + 1)});
        result.push_back({a, vertex(row + 1, ahead - 1), c});
      }
    }
    return result;
  }

  [[nodiscard]] GridPoint point(mesh::NodeIndex v) const {
    const int row = v / num_around_;
    return {static_cast<double>(row) / num_rows_,
            (v % num_around_ + 0.5 * (row % 2)) / num_around_};
  }

  [[nodiscard]] GridPoint middle(const mesh::Edge& edge) const {
    const GridPoint a = point(edge[0]);
    const GridPoint b = point(edge[1]);
    return {middle_on_circle(a.along, b.along), middle_on_circle(a.around, b.around)};
  }

 private:
  [[nodiscard]] mesh::NodeIndex vertex(int row, int j) const {
    return (row % num_rows_) * num_around_ + (j + num_around_) % num_around_;
  }

  /// On the shorter way between two coordinates of period 1.
  static double middle_on_circle(double from, double to) {
    const double step = to - from;
    return from + 0.5 * (step - std::round(step));
  }

  int num_rows_;
  int num_around_;
};

/// Angle around the tube is 0 at the outer equator: tan(theta / 2) = sqrt((R + r) / (R - r))
/// tan(pi u).
Eigen::RowVector3d place(double major_radius, double minor_radius, const GridPoint& point) {
  const double ratio = std::sqrt((major_radius + minor_radius) / (major_radius - minor_radius));
  const double u = point.around - std::round(point.around);
  const double theta =
      2 * std::atan2(ratio * std::sin(std::numbers::pi * u), std::cos(std::numbers::pi * u));
  const double distance = major_radius + minor_radius * std::cos(theta);
  const double azimuth = two_pi * point.along;
  return {distance * std::cos(azimuth), distance * std::sin(azimuth),
          minor_radius * std::sin(theta)};
}

}  // namespace

double torus_rows(double major_radius, double minor_radius, int num_around_tube) {
  // In conformal coordinates the tube is 2 pi r / sqrt(R^2 - r^2) around and 2 pi along.
  const double around =
      minor_radius / std::sqrt((major_radius - minor_radius) * (major_radius + minor_radius));
  const double row_distance = std::sqrt(0.75) * around / num_around_tube;
  return std::max(4.0, 2 * std::round(0.5 / row_distance));
}

mesh::Surface torus_surface(double major_radius, double minor_radius, int num_around_tube) {
  const auto num_rows = static_cast<int>(torus_rows(major_radius, minor_radius, num_around_tube));
  const TorusGrid grid(num_rows, num_around_tube);
  mesh::QuadraticConnectivity connectivity =
      mesh::add_edge_nodes(grid.triangles(), grid.num_vertices());
  const auto num_nodes =
      grid.num_vertices() + static_cast<mesh::NodeIndex>(connectivity.edges.size());
  mesh::Positions positions(num_nodes, 3);
  Eigen::Index row = 0;
  for (mesh::NodeIndex v = 0; v < grid.num_vertices(); ++v) {
    positions.row(row++) = place(major_radius, minor_radius, grid.point(v));
  }
  for (const mesh::Edge& edge : connectivity.edges) {
    positions.row(row++) = place(major_radius, minor_radius, grid.middle(edge));
  }
  return {std::make_shared<const mesh::Triangulation>(std::move(connectivity.triangles), num_nodes),
          std::move(positions)};
}

}  // namespace vesica::shapes
