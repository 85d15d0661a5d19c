#include "sphere_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "vesica/mesh/edges.hpp"

namespace vesica::shapes {
namespace {

struct TriangleMesh {
  std::vector<mesh::Corners> triangles;
  std::vector<Eigen::Vector3d> vertices;
};

/// Mid-edge nodes are projected chord midpoints.
mesh::Surface lift_onto_sphere(const TriangleMesh& mesh) {
  const auto num_vertices = static_cast<mesh::NodeIndex>(mesh.vertices.size());
  mesh::QuadraticConnectivity connectivity = mesh::add_edge_nodes(mesh.triangles, num_vertices);
  const std::size_t num_nodes = mesh.vertices.size() + connectivity.edges.size();
  mesh::Positions positions(static_cast<Eigen::Index>(num_nodes), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector3d& vertex : mesh.vertices) positions.row(row++) = vertex.normalized();
  for (const auto& [a, b] : connectivity.edges) {
    positions.row(row++) = (positions.row(a) + positions.row(b)).normalized();
  }
  return {std::make_shared<const mesh::Triangulation>(std::move(connectivity.triangles),
                                                      static_cast<mesh::NodeIndex>(num_nodes)),
          std::move(positions)};
}

/// Each triangle's longest edge, the diagonal, lies between its first two corners.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).normalized());
  }
  constexpr std::array<std::array<mesh::NodeIndex, 4>, 6> faces = {
      {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 2, 3, 1}, {6, 4, 5, 7}}};
  for (const auto& face : faces) {
    mesh.triangles.push_back({face[2], face[0], face[1]});
    mesh.triangles.push_back({face[0], face[2], face[3]});
  }
  return mesh;
}

/// Cuts each triangle between its first two corners; the children's edges opposite to the new
/// vertex come first, because they are cut next.
void bisect(TriangleMesh& mesh) {
  std::map<mesh::Edge, mesh::NodeIndex> middles;
  std::vector<mesh::Corners> children;
  children.reserve(2 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto [entry, is_new] =
        middles.try_emplace(mesh::Edge{std::min(a, b), std::max(a, b)},
                            static_cast<mesh::NodeIndex>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(
          (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)])
              .normalized());
    }
    children.push_back({c, a, entry->second});
    children.push_back({b, c, entry->second});
  }
  mesh.triangles = std::move(children);
}

/// Numbers the points of the subdivided icosahedron: equal points of neighbouring faces get one
/// number. A point is known by its corners with their non-zero weights.
class FacePoints {
 public:
  mesh::NodeIndex number(const mesh::Corners& corners, const std::array<int, 3>& weights,
                         double edge_angle, int frequency) {
    Key key;
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[i] > 0) key.emplace_back(corners[i], weights[i]);
    }
    std::sort(key.begin(), key.end());
    const auto [entry, is_new] =
        numbers_.try_emplace(std::move(key), static_cast<mesh::NodeIndex>(points_.size()));
    if (is_new) {
      // On an edge these weights divide the great circle evenly; inside they continue it smoothly.
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 3; ++i) {
        sum += std::sin(edge_angle * weights[i] / frequency) *
               corner_positions_.row(corners[i]).transpose();
      }
      points_.push_back(sum.normalized());
    }
    return entry->second;
  }

  std::vector<Eigen::Vector3d> take_points() && { return std::move(points_); }

 private:
  using Key = std::vector<std::pair<mesh::NodeIndex, int>>;
  mesh::Positions corner_positions_ = icosahedron_vertices();
  std::map<Key, mesh::NodeIndex> numbers_;
  std::vector<Eigen::Vector3d> points_;
};

constexpr std::array<mesh::Corners, 20> icosahedron_triangles = {
    {{0, 1, 2},  {0, 2, 3},  {0, 3, 4},  {0, 4, 5},  {0, 5, 1},   {1, 6, 2},  {2, 6, 7},
     {2, 7, 3},  {3, 7, 8},  {3, 8, 4},  {4, 8, 9},  {4, 9, 5},   {5, 9, 10}, {5, 10, 1},
     {1, 10, 6}, {6, 11, 7}, {7, 11, 8}, {8, 11, 9}, {9, 11, 10}, {10, 11, 6}}};

}  // namespace

mesh::Surface unit_sphere_from_cube(int num_bisections) {
  TriangleMesh mesh = cube();
  for (int i = 0; i < num_bisections; ++i) bisect(mesh);
  return lift_onto_sphere(mesh);
}

mesh::Positions icosahedron_vertices() {
  const double height = 1 / std::sqrt(5.0);
  const double radius = 2 * height;
  mesh::Positions vertices(12, 3);
  vertices.row(0) = Eigen::RowVector3d(0, 0, 1);
  vertices.row(11) = Eigen::RowVector3d(0, 0, -1);
  for (int i = 0; i < 5; ++i) {
    const double upper = 2 * std::numbers::pi * i / 5;
    const double lower = upper + std::numbers::pi / 5;
    vertices.row(1 + i) << radius * std::cos(upper), radius * std::sin(upper), height;
    vertices.row(6 + i) << radius * std::cos(lower), radius * std::sin(lower), -height;
  }
  return vertices;
}

mesh::Surface unit_sphere_from_icosahedron(int frequency) {
  const double edge_angle = std::atan(2.0);
  FacePoints points;
  TriangleMesh mesh;
  for (const mesh::Corners& face : icosahedron_triangles) {
    const auto point = [&](int i, int j) {
      return points.number(face, {frequency - i - j, i, j}, edge_angle, frequency);
    };
    for (int i = 0; i < frequency; ++i) {
      for (int j = 0; i + j < frequency; ++j) {
        mesh.triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 2 > frequency) continue;
        mesh.triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
    }
  }
  mesh.vertices = std::move(points).take_points();
  return lift_onto_sphere(mesh);
}

}  // namespace vesica::shapes
