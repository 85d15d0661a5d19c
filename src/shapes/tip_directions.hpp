#pragma once

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Unit vectors, well apart, shape (num_tips, 3): 1 pole (x), 2 poles, 3 triangle, 4 tetrahedron,
/// 6 octahedron, 12 icosahedron; other numbers by the repulsion of equal charges.
[[nodiscard]] mesh::Positions tip_directions(int num_tips);

}  // namespace vesica::shapes
