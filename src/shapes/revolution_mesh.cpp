#include "revolution_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "vesica/mesh/edges.hpp"

namespace vesica::shapes {
namespace {

/// Point of the outer faces of the glued cubes, counted in half squares: [0, 2 m n] x [0, 2 m]^2.
using LatticePoint = std::array<int, 3>;

/// Numbers lattice points in the order of their first use.
class VertexNumbers {
 public:
  mesh::NodeIndex number(const LatticePoint& point) {
    const auto [entry, is_new] =
        numbers_.try_emplace(point, static_cast<mesh::NodeIndex>(points_.size()));
    if (is_new) points_.push_back(point);
    return entry->second;
  }
  [[nodiscard]] const std::vector<LatticePoint>& points() const { return points_; }

 private:
  std::map<LatticePoint, mesh::NodeIndex> numbers_;
  std::vector<LatticePoint> points_;
};

struct BoxMesh {
  std::vector<mesh::Corners> triangles;
  std::vector<LatticePoint> vertices;
};

/// One face: corner and the steps (in half squares) along its two sides, step_1 x step_2 outward.
struct Face {
  LatticePoint corner;
  LatticePoint step_1;
  LatticePoint step_2;
  int num_1;
  int num_2;
};

LatticePoint face_point(const Face& face, int i, int j) {
  LatticePoint point = face.corner;
  for (std::size_t k = 0; k < 3; ++k) point[k] += 2 * (i * face.step_1[k] + j * face.step_2[k]);
  return point;
}

/// The diagonals point to the nearest corner of the face: there three faces meet at about 120
/// degrees each, which the diagonals cut into six angles of about 60.
void add_face(const Face& face, VertexNumbers& numbers, std::vector<mesh::Corners>& triangles) {
  for (int i = 0; i < face.num_1; ++i) {
    for (int j = 0; j < face.num_2; ++j) {
      const mesh::NodeIndex a = numbers.number(face_point(face, i, j));
      const mesh::NodeIndex b = numbers.number(face_point(face, i + 1, j));
      const mesh::NodeIndex c = numbers.number(face_point(face, i + 1, j + 1));
      const mesh::NodeIndex d = numbers.number(face_point(face, i, j + 1));
      const bool is_rising = (2 * i < face.num_1) == (2 * j < face.num_2);
      if (is_rising) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  }
}

BoxMesh box_mesh(int n, int m) {
  const int length = 2 * m * n;
  const int width = 2 * m;
  const std::array<Face, 6> faces = {{{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, m, m},
                                      {{length, 0, 0}, {0, 1, 0}, {0, 0, 1}, m, m},
                                      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, m * n, m},
                                      {{0, width, 0}, {0, 0, 1}, {1, 0, 0}, m, m * n},
                                      {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, m, m * n},
                                      {{0, 0, width}, {1, 0, 0}, {0, 1, 0}, m * n, m}}};
  BoxMesh mesh;
  VertexNumbers numbers;
  for (const Face& face : faces) add_face(face, numbers, mesh.triangles);
  mesh.vertices = numbers.points();
  return mesh;
}

/// Place on a surface of revolution: parameter of the profile and angle around the axis.
struct MeridianPoint {
  double parameter;
  double azimuth;
};

class BoxMap {
 public:
  explicit BoxMap(const RevolutionOptions& options) : options_(options) {}

  [[nodiscard]] MeridianPoint operator()(const LatticePoint& point) const {
    const int m = options_.num_squares;
    const int length = 2 * m * options_.num_cubes;
    const double y = static_cast<double>(point[1]) / m - 1;
    const double z = static_cast<double>(point[2]) / m - 1;
    const bool is_right = 2 * point[0] > length;
    const int depth = is_right ? length - point[0] : point[0];
    MeridianPoint place = on_end_face(y, z);
    if (depth > 0) place = on_side(place, y, z, 2.0 * depth / length);
    if (is_right) place.parameter = 1 - place.parameter;
    return place;
  }

 private:
  /// Equiangular square around the pole; y, z in [-1, 1].
  [[nodiscard]] MeridianPoint on_end_face(double y, double z) const {
    const double alpha = options_.cap_angle;
    const double tan_y = std::tan(alpha * y);
    const double tan_z = std::tan(alpha * z);
    const double polar_angle = std::atan(std::hypot(tan_y, tan_z));
    // The middle of its sides lies where rows that are equidistant along a meridian put it.
    const double per_angle = 0.5 / ((options_.num_cubes + 1) * alpha);
    return {per_angle * polar_angle, std::atan2(tan_z, tan_y)};
  }

  /// From the rim of the end face (depth 0) to the circle in the middle (depth 1).
  [[nodiscard]] MeridianPoint on_side(const MeridianPoint& rim, double y, double z,
                                      double depth) const {
    const double quarter = std::numbers::pi / 4;
    double azimuth = 0;
    if (std::abs(y) >= std::abs(z)) {
      azimuth = y > 0 ? quarter * z : std::copysign(4 * quarter, rim.azimuth) - quarter * z;
    } else {
      azimuth = z > 0 ? 2 * quarter - quarter * y : -2 * quarter + quarter * y;
    }
    return {rim.parameter + (0.5 - rim.parameter) * depth,
            rim.azimuth + (azimuth - rim.azimuth) * depth};
  }

  RevolutionOptions options_;
};

Eigen::RowVector3d place_on(const Profile& profile, const MeridianPoint& place) {
  const Eigen::Vector2d point = profile(place.parameter);
  return {point.x(), point.y() * std::cos(place.azimuth), point.y() * std::sin(place.azimuth)};
}

}  // namespace

mesh::Surface revolution_surface(const RevolutionOptions& options, const Profile& profile) {
  BoxMesh box = box_mesh(options.num_cubes, options.num_squares);
  const auto num_vertices = static_cast<mesh::NodeIndex>(box.vertices.size());
  mesh::QuadraticConnectivity connectivity = mesh::add_edge_nodes(box.triangles, num_vertices);
  std::vector<LatticePoint> points = std::move(box.vertices);
  for (const auto& [a, b] : connectivity.edges) {
    LatticePoint middle{};
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] =
          (points[static_cast<std::size_t>(a)][k] + points[static_cast<std::size_t>(b)][k]) / 2;
    }
    points.push_back(middle);
  }
  const BoxMap map(options);
  mesh::Positions positions(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    positions.row(static_cast<Eigen::Index>(i)) = place_on(profile, map(points[i]));
  }
  return {std::make_shared<const mesh::Triangulation>(std::move(connectivity.triangles),
                                                      static_cast<mesh::NodeIndex>(points.size())),
          std::move(positions)};
}

}  // namespace vesica::shapes
