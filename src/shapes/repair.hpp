#pragma once

#include <string>
#include <vector>

#include "shapes/formats/formats.hpp"

namespace vesica::shapes {

/// Mends a surface as `shape.repair` promises, and tells what was done, one sentence each.
[[nodiscard]] std::vector<std::string> repair(SurfaceData& data);

/// Names two points at the same place and counts all such points; empty when there are none.
[[nodiscard]] std::string coincident_points(const SurfaceData& data);

}  // namespace vesica::shapes
