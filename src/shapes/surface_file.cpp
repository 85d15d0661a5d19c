#include "vesica/shapes/surface_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "repair.hpp"
#include "shapes/formats/formats.hpp"
#include "shapes/formats/renumber.hpp"
#include "smoothing.hpp"
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

using Parse = SurfaceData (*)(const std::string& path, std::string_view bytes);

constexpr std::array<std::pair<std::string_view, Parse>, 10> parsers = {{{".off", parse_off},
                                                                         {".obj", parse_obj},
                                                                         {".ply", parse_ply},
                                                                         {".stl", parse_stl},
                                                                         {".vtk", parse_vtk},
                                                                         {".vtu", parse_vtk_xml},
                                                                         {".vtp", parse_vtk_xml},
                                                                         {".msh", parse_gmsh},
                                                                         {".tsi", parse_tsi},
                                                                         {".q", parse_q}}};

SurfaceData with_checked_fields(SurfaceData data) {
  for (const mesh::PointField& field : data.fields) {
    if (field.values.size() == std::ssize(data.points)) continue;
    throw ConfigError(fmt::format("{}: {} values: must be one for each of the {} points",
                                  field.source, field.values.size(), data.points.size()));
  }
  return data;
}

SurfaceData read_data(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const auto& [name, parse] : parsers) {
    if (name == ending) return with_checked_fields(parse(path, read_text(path)));
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
  }
  throw ConfigError(fmt::format("{}: extension '{}': must be one of {}", path, ending, known));
}

/// A flat triangle without area has no normal, and the lifting needs one.
void check_flat_triangles(const SurfaceData& data) {
  constexpr double smallest_relative_area = 1e-10;
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const auto& [i, j, k] = data.triangles[t];
    const auto at = [&](mesh::NodeIndex node) {
      return data.points[static_cast<std::size_t>(node)];
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
std::vector<Eigen::Vector3d> vertex_normals(const SurfaceData& data) {
  std::vector<Eigen::Vector3d> normals(data.points.size(), Eigen::Vector3d::Zero());
  for (const mesh::Corners& corners : data.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto node = static_cast<std::size_t>(corners[i]);
      const Eigen::Vector3d& vertex = data.points[node];
      const Eigen::Vector3d e =
          data.points[static_cast<std::size_t>(corners[(i + 1) % 3])] - vertex;
      const Eigen::Vector3d f =
          data.points[static_cast<std::size_t>(corners[(i + 2) % 3])] - vertex;
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

mesh::Surface lift(const SurfaceData& data) {
  const auto num_vertices = static_cast<mesh::NodeIndex>(data.points.size());
  mesh::QuadraticConnectivity connectivity = mesh::add_edge_nodes(data.triangles, num_vertices);
  const std::size_t num_nodes = data.points.size() + connectivity.edges.size();
  auto triangulation = std::make_shared<const mesh::Triangulation>(
      std::move(connectivity.triangles), static_cast<mesh::NodeIndex>(num_nodes));
  check_flat_triangles(data);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(data);
  mesh::Positions positions(static_cast<Eigen::Index>(num_nodes), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector3d& vertex : data.points) positions.row(row++) = vertex;
  for (const auto& edge : connectivity.edges) {
    const auto a = static_cast<std::size_t>(edge[0]);
    const auto b = static_cast<std::size_t>(edge[1]);
    positions.row(row++) = edge_midpoint(data.points[a], normals[a], data.points[b], normals[b]);
  }
  return {std::move(triangulation), std::move(positions)};
}

/// Quadratic triangles as they stand.
mesh::Surface quadratic_surface(const SurfaceData& data) {
  std::vector<mesh::QuadraticTriangle> triangles;
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const auto& [a, b, c] = data.triangles[t];
    const auto& [ab, bc, ca] = data.middles[t];
    triangles.push_back({a, b, c, ab, bc, ca});
  }
  mesh::Positions positions(static_cast<Eigen::Index>(data.points.size()), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector3d& point : data.points) positions.row(row++) = point;
  return {std::make_shared<const mesh::Triangulation>(
              std::move(triangles), static_cast<mesh::NodeIndex>(data.points.size())),
          std::move(positions)};
}

/// Lifts or takes the surface, and looks at it.
mesh::Surface sound_surface(SurfaceData& data, const Mending& mending) {
  if (!data.middles.empty()) put_corners_first(data);
  if (mending.smoothing > 0) smooth(data, mending.smoothing);
  return mesh::check_geometry(data.middles.empty() ? lift(data) : quadratic_surface(data),
                              mending.flips);
}

/// What else is wrong with a surface that is refused, and whether a repair would mend it.
std::string advice(SurfaceData data, const Mending& mending) {
  if (mending.repairs) return "";
  std::string text = coincident_points(data);
  if (!text.empty()) text = "; " + text;
  try {
    const std::vector<std::string> done = repair(data);
    (void)sound_surface(data, mending);
    return fmt::format("{}; shape.repair = true mends this surface: {}", text,
                       fmt::join(done, ", "));
  } catch (const ConfigError&) {
    return text;
  }
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

Shape read_shape(const std::string& path, const Mending& mending) {
  SurfaceData data = read_data(path);
  std::vector<std::string> notes;
  if (mending.repairs) {
    for (const std::string& done : repair(data))
      notes.push_back(fmt::format("shape.repair: {}: {}", path, done));
  }
  const SurfaceData as_read = data;
  try {
    mesh::Surface surface = sound_surface(data, mending);
    return {std::move(surface), std::move(data.fields), std::move(notes)};
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {} (nodes and triangles counted from 0){}", path,
                                  error.what(), advice(as_read, mending)));
  }
}

mesh::Surface read_surface(const std::string& path, bool flip) {
  return read_shape(path, {.flips = flip}).surface;
}

}  // namespace vesica::shapes
