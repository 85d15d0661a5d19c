#pragma once

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Torus around the z axis, centred at 0, with `num_around_tube` elements around the tube. The rows
/// are equidistant in conformal coordinates, so that all triangles are nearly equilateral, and
/// larger outside than inside by (R + r) / (R - r). Needs 0 < minor_radius < major_radius [length].
[[nodiscard]] mesh::Surface torus_surface(double major_radius, double minor_radius,
                                          int num_around_tube);

/// Number of rows along the ring for near-equilateral triangles: even, a double because it is what
/// the check of the number of nodes looks at first.
[[nodiscard]] double torus_rows(double major_radius, double minor_radius, int num_around_tube);

}  // namespace vesica::shapes
