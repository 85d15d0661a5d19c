#pragma once

#include <Eigen/Core>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Unit sphere from the cube whose faces have one diagonal each, after `num_bisections` bisections
/// of every triangle at its longest edge; new nodes are projected (Section 3.6).
/// 24 * 2^num_bisections + 2 nodes.
[[nodiscard]] mesh::Surface unit_sphere_from_cube(int num_bisections);

/// Unit sphere from the icosahedron, each edge cut into `frequency` pieces of equal angle.
/// 40 frequency^2 + 2 nodes.
[[nodiscard]] mesh::Surface unit_sphere_from_icosahedron(int frequency);

/// The twelve vertices of the icosahedron on the unit sphere.
[[nodiscard]] mesh::Positions icosahedron_vertices();

}  // namespace vesica::shapes
