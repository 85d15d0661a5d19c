#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "shapes/formats/formats.hpp"

namespace vesica::shapes {

/// Cells as VTK keeps them: cell i has the points connectivity[offsets[i]] to
/// connectivity[offsets[i + 1]].
struct Cells {
  std::vector<double> connectivity;
  std::vector<double> offsets;
  std::vector<double> types;  ///< numbers of VTK; empty: polygons
};

/// Refuses with a text behind the place in the file.
using RefuseCells = std::function<void(const std::string& text)>;

/// Adds a triangle with its points: three, or six of a quadratic one in the order of
/// mesh::QuadraticTriangle.
void add_triangle(const std::vector<mesh::NodeIndex>& nodes, SurfaceData& data);

/// Adds the triangles among the cells to `data`, whose points are known; points and lines are
/// passed over. Refuses other cells, and flat and quadratic triangles together.
void add_cells(const Cells& cells, SurfaceData& data, const RefuseCells& refuse);

}  // namespace vesica::shapes
