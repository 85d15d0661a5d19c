#pragma once

#include <vector>

#include "shapes/formats/formats.hpp"

namespace vesica::shapes {

/// Gives points new numbers: point i becomes `numbers[i]`, or goes where that is -1; no triangle
/// may use it then. Of several points with one number the first stays. The numbers that are given
/// are 0 to `num_points` - 1.
void renumber(SurfaceData& data, const std::vector<mesh::NodeIndex>& numbers,
              mesh::NodeIndex num_points);

/// Puts the corners of quadratic triangles before all other points, in the order they have.
void put_corners_first(SurfaceData& data);

}  // namespace vesica::shapes
