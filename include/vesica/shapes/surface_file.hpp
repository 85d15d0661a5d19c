#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Reads a closed triangulated surface from an OFF (.off) or OBJ (.obj) file and lifts its edges to
/// quadratic ones. The file's vertices keep their order and come first (counted from 0), then one
/// mid-edge node an edge as placed by edge_midpoint with vertex normals estimated from the
/// triangles (weights of Max 1999, exact on a sphere).
///
/// OFF: header `OFF` (may be left out), comments, ASCII. OBJ: `v` and `f` (forms a, a/b, a/b/c,
/// a//c, negative indices); `vn`, `vt`, `o`, `g`, `s`, `usemtl`, `mtllib` are passed over. Faces
/// must be triangles and every vertex must be used.
///
/// Throws IoError when the file cannot be read; ConfigError with file and line when it is
/// malformed, and with file and first offending edge or face when Triangulation or check_geometry
/// refuses the surface. `flip` turns a surface that is inside out.
[[nodiscard]] mesh::Surface read_surface(const std::string& path, bool flip);

/// Returns the middle of the smooth curve over the edge from `a` to `b` whose surface has unit
/// normals `normal_a`, `normal_b` there:
///
///     (a + b)/2 + |b - a|/4 (tan(d_a/2) + tan(d_b/2)) n,   sin d_a = -(b - a).n_a / |b - a|,
///                                                          sin d_b =  (b - a).n_b / |b - a|
///
/// with n the mean normal, made perpendicular to the edge. Exact on a sphere; on a smooth surface
/// with exact normals the distance to the surface is O(|b - a|^4), with normals that are second
/// order accurate O(|b - a|^3). The chord's midpoint is only second order.
[[nodiscard]] Eigen::Vector3d edge_midpoint(const Eigen::Vector3d& a,
                                            const Eigen::Vector3d& normal_a,
                                            const Eigen::Vector3d& b,
                                            const Eigen::Vector3d& normal_b);

}  // namespace vesica::shapes
