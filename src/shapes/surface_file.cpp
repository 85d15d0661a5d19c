#include "vesica/shapes/surface_file.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

#include "polygon_file.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/edges.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::shapes {
namespace {

std::string read_text(const std::string& path) {
  if (std::error_code error; std::filesystem::is_directory(path, error)) {
    throw IoError(fmt::format("{}: cannot be read: it is a folder", path));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw IoError(fmt::format("{}: cannot be opened for reading", path));
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) throw IoError(fmt::format("{}: cannot be read", path));
  return text;
}

PolygonFile read_polygons(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".off" && extension != ".obj") {
    throw ConfigError(fmt::format("{}: extension '{}': must be .off or .obj", path, extension));
  }
  const std::string text = read_text(path);
  return extension == ".off" ? parse_off(path, text) : parse_obj(path, text);
}

/// A flat triangle without area has no normal, and the lifting needs one.
void check_flat_triangles(const PolygonFile& file) {
  constexpr double smallest_relative_area = 1e-10;
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    const auto& [i, j, k] = file.triangles[t];
    const auto at = [&](mesh::NodeIndex node) {
      return file.vertices[static_cast<std::size_t>(node)];
    };
    const Eigen::Vector3d side_1 = at(j) - at(i);
    const Eigen::Vector3d side_2 = at(k) - at(i);
    const double longest_squared =
        std::max({side_1.squaredNorm(), side_2.squaredNorm(), (side_2 - side_1).squaredNorm()});
    if (!(side_1.cross(side_2).norm() > smallest_relative_area * longest_squared)) {
      throw ConfigError(fmt::format(
          "triangle {} (nodes {}, {}, {}) is degenerate: its area must be > 0", t, i, j, k));
    }
  }
}

/// Sum of (e x f) / (|e|^2 |f|^2) over the pairs of sides e, f at a vertex (Max 1999).
std::vector<Eigen::Vector3d> vertex_normals(const PolygonFile& file) {
  std::vector<Eigen::Vector3d> normals(file.vertices.size(), Eigen::Vector3d::Zero());
  for (const mesh::Corners& corners : file.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto node = static_cast<std::size_t>(corners[i]);
      const Eigen::Vector3d& vertex = file.vertices[node];
      const Eigen::Vector3d e =
          file.vertices[static_cast<std::size_t>(corners[(i + 1) % 3])] - vertex;
      const Eigen::Vector3d f =
          file.vertices[static_cast<std::size_t>(corners[(i + 2) % 3])] - vertex;
      normals[node] += e.cross(f) / (e.squaredNorm() * f.squaredNorm());
    }
  }
  for (std::size_t node = 0; node < normals.size(); ++node) {
    const double length = normals[node].norm();
    if (!(length > 0)) {
      throw ConfigError(fmt::format("node {} has no normal: its triangles cancel", node));
    }
    normals[node] /= length;
  }
  return normals;
}

mesh::Surface lift(const PolygonFile& file) {
  const auto num_vertices = static_cast<mesh::NodeIndex>(file.vertices.size());
  mesh::QuadraticConnectivity connectivity = mesh::add_edge_nodes(file.triangles, num_vertices);
  const std::size_t num_nodes = file.vertices.size() + connectivity.edges.size();
  auto triangulation = std::make_shared<const mesh::Triangulation>(
      std::move(connectivity.triangles), static_cast<mesh::NodeIndex>(num_nodes));
  check_flat_triangles(file);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(file);
  mesh::Positions positions(static_cast<Eigen::Index>(num_nodes), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector3d& vertex : file.vertices) positions.row(row++) = vertex;
  for (const auto& edge : connectivity.edges) {
    const auto a = static_cast<std::size_t>(edge[0]);
    const auto b = static_cast<std::size_t>(edge[1]);
    positions.row(row++) =
        edge_midpoint(file.vertices[a], normals[a], file.vertices[b], normals[b]);
  }
  return {std::move(triangulation), std::move(positions)};
}

}  // namespace

Eigen::Vector3d edge_midpoint(const Eigen::Vector3d& a, const Eigen::Vector3d& normal_a,
                              const Eigen::Vector3d& b, const Eigen::Vector3d& normal_b) {
  const double length = (b - a).norm();
  const Eigen::Vector3d along = (b - a) / length;
  Eigen::Vector3d normal = normal_a + normal_b;
  normal -= normal.dot(along) * along;
  const double size = normal.norm();
  if (!(size > 0)) return 0.5 * (a + b);
  const auto tan_half = [](double sine) {
    return sine / (1 + std::sqrt(std::max(0.0, 1 - sine * sine)));
  };
  const double height =
      0.25 * length * (tan_half(-along.dot(normal_a)) + tan_half(along.dot(normal_b)));
  return 0.5 * (a + b) + height / size * normal;
}

mesh::Surface read_surface(const std::string& path, bool flip) {
  const PolygonFile file = read_polygons(path);
  try {
    return mesh::check_geometry(lift(file), flip);
  } catch (const ConfigError& error) {
    throw ConfigError(
        fmt::format("{}: {} (nodes and triangles counted from 0)", path, error.what()));
  }
}

}  // namespace vesica::shapes
