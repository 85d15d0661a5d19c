#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vesica/mesh/triangulation.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {

/// What is done to a surface from a file.
struct Mending {
  bool flips = false;
  bool repairs = false;
  int smoothing = 0;  ///< passes
};

/// Reads a closed triangulated surface and the point fields of its file. The ending tells the
/// format:
///
///   .off        OFF, text
///   .obj        `v` and `f` (forms a, a/b, a/b/c, a//c, negative indices); `vn`, `vt`, `o`, `g`,
///               `s`, `usemtl`, `mtllib` are passed over
///   .ply        text, or binary of both byte orders; scalar properties of vertices are fields
///   .stl        text or binary; vertices at the same place become one
///   .vtk        legacy format of VTK, text or binary: UNSTRUCTURED_GRID or POLYDATA
///   .vtu .vtp   XML format of VTK: text, base64 or appended, compressed by zlib or not
///   .msh        Gmsh 2.2 or 4.1, text or binary; $NodeData are fields
///   .tsi .q     FreeDTS; fields `domain` and `inclusion` (the type at a vertex, 0 for none)
///
/// Points and lines of VTK and Gmsh are passed over, all other elements must be triangles. Every
/// vertex must be used.
///
/// The edges of flat triangles are lifted to quadratic ones: the file's vertices keep their order
/// and come first (counted from 0), then one mid-edge node an edge as placed by edge_midpoint with
/// vertex normals estimated from the triangles (weights of Max 1999, exact on a sphere). Quadratic
/// triangles of VTK and Gmsh are taken as they stand; corners come first, then mid-edge nodes, each
/// in the order of the file.
///
/// `flips` turns a surface that is inside out. `repairs` mends a surface before it is looked at:
/// vertices at the same place (to a millionth of the diagonal of the bounding box) become one,
/// triangles that repeat a corner or another triangle go, triangles are turned so that all run the
/// same way round and outwards, the part with the largest volume is kept, and unused vertices go.
/// The notes tell what was done. Nothing else is mended: holes and edges of three triangles are
/// refused.
///
/// Each pass of `smoothing` moves every vertex of flat triangles by half of the way to the mean of
/// its neighbours, and then by 0.53 of that way back (Taubin 1995): what is rough on the scale of
/// an edge goes, and the volume nearly stays.
///
/// Throws IoError when the file cannot be read; ConfigError with file and line (or byte) when it is
/// malformed, and with file and first offending edge or face when Triangulation or check_geometry
/// refuses the surface; the message then tells whether a repair would mend it.
[[nodiscard]] Shape read_shape(const std::string& path, const Mending& mending = {});

/// Reads a surface as read_shape does.
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
