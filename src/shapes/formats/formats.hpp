#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "vesica/mesh/point_field.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// What a surface file says: points and triangles in the order of the file.
struct SurfaceData {
  std::vector<Eigen::Vector3d> points;
  std::vector<mesh::Corners> triangles;
  /// Mid-edge points of the triangles, on the sides 01, 12, 20; empty for flat triangles.
  std::vector<mesh::Corners> middles;
  std::vector<mesh::PointField> fields;  ///< one value a point
};

// Parse the bytes of a file; `path` only for messages. Throw ConfigError that names the place
// (path and line, in binary parts the byte), the object and the rule.

[[nodiscard]] SurfaceData parse_off(const std::string& path, std::string_view text);
[[nodiscard]] SurfaceData parse_obj(const std::string& path, std::string_view text);
/// Stanford polygon file, text or binary.
[[nodiscard]] SurfaceData parse_ply(const std::string& path, std::string_view bytes);
/// Stereolithography, text or binary; vertices at the same place become one.
[[nodiscard]] SurfaceData parse_stl(const std::string& path, std::string_view bytes);
/// Legacy VTK file, text or binary: DATASET UNSTRUCTURED_GRID or POLYDATA.
[[nodiscard]] SurfaceData parse_vtk(const std::string& path, std::string_view bytes);
/// XML file of VTK, UnstructuredGrid (.vtu) or PolyData (.vtp).
[[nodiscard]] SurfaceData parse_vtk_xml(const std::string& path, std::string_view bytes);
/// Gmsh format 2.2 or 4.1, text or binary.
[[nodiscard]] SurfaceData parse_gmsh(const std::string& path, std::string_view bytes);
/// Files of FreeDTS: .tsi, with the point fields `domain` and `inclusion`, and .q, with `domain`.
[[nodiscard]] SurfaceData parse_tsi(const std::string& path, std::string_view text);
[[nodiscard]] SurfaceData parse_q(const std::string& path, std::string_view text);

}  // namespace vesica::shapes
