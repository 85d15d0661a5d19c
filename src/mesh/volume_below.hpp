#pragma once

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// 1/3 int x . (x_u cross x_v) du dv over one quadratic triangle: its share of the enclosed volume.
[[nodiscard]] double volume_below(const QuadraticTriangle& nodes, const Positions& positions);

}  // namespace vesica::mesh
