#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "vesica/mesh/point_field.hpp"
#include "vesica/mesh/triangulation.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::io {

/// Writes a surface to a file whose ending tells the format:
///
///   .vtu   quadratic triangles with all nodes, and the fields at them
///   .ply   flat triangles: the vertices in the order of their nodes, with the fields at them
///   .obj   the same without fields
///
/// All are text with as many digits as the numbers have. Fields have one value a node. Throws
/// ConfigError for another ending, and IoError when the file cannot be written.
void write_surface(const std::filesystem::path& path, const mesh::Surface& surface,
                   std::span<const mesh::PointField> fields);

/// Returns the nodal fields of a state that has them, by their names in ParaView: the order
/// parameter `c`, and the mean curvature `kappa` [1/length].
[[nodiscard]] std::vector<mesh::PointField> fields_of(const problem::State& state);

}  // namespace vesica::io
