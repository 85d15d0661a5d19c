#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// What an OFF or OBJ file says: vertices and triangles in the order of the file.
struct PolygonFile {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Corners> triangles;
};

/// Parse the text of a file; `path` only for messages. Throw ConfigError with path and line.
[[nodiscard]] PolygonFile parse_off(const std::string& path, std::string_view text);
[[nodiscard]] PolygonFile parse_obj(const std::string& path, std::string_view text);

}  // namespace vesica::shapes
