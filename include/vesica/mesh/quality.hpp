#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

// "Sub-triangles" are the four flat triangles between neighbouring nodes of a quadratic triangle:
// (0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5). Positions have shape (num_nodes, 3).

/// Returns the smallest sine of the inner angles of a flat triangle; 0 without area.
[[nodiscard]] double smallest_sine(const std::array<Eigen::Vector3d, 3>& corners);

/// Returns q = min over sub-triangles of the sine of their inner angles, (3.5); in (0, sqrt(3)/2].
/// 0 when a sub-triangle has no area.
[[nodiscard]] double quality(const Triangulation& triangulation, const Positions& positions);

/// Returns the smallest cosine of the angle between the flat normals of two neighbouring
/// sub-triangles, inside a triangle and across the edges between triangles; in [-1, 1]. Near -1 for
/// a fold, which (3.5) does not see; -1 when a sub-triangle has no area.
[[nodiscard]] double smallest_normal_cosine(const Triangulation& triangulation,
                                            const Positions& positions);

/// Returns the area of the four sub-triangles together of each triangle [length^2], shape
/// (num_triangles).
[[nodiscard]] std::vector<double> element_areas(const Triangulation& triangulation,
                                                const Positions& positions);

/// Returns the largest element area over the smallest, >= 1; infinite when an element has no area.
[[nodiscard]] double area_ratio(const Triangulation& triangulation, const Positions& positions);

/// Returns the volume enclosed by the quadratic surface [length^3], 1/3 int x . nu: exact up to
/// rounding, positive for outward orientation.
[[nodiscard]] double enclosed_volume(const Triangulation& triangulation,
                                     const Positions& positions);

/// Returns `surface` if it can carry a membrane and throws ConfigError otherwise, naming the first
/// offending node, face or edge: positions that are not finite, coincident nodes of one triangle,
/// a sub-triangle without area (below 1e-10 of its longest side squared), a folded triangle
/// (normals of two sub-triangles more than 90 degrees apart), neighbours folded onto each other
/// (normals at the common edge more than 150 degrees apart), a component that is inside out
/// (encloses negative volume). With `flip` such a component is turned inside in: its triangles
/// (0, 1, 2, 3, 4, 5) become (0, 2, 1, 5, 4, 3), node numbers and positions stay.
/// Intersections of the surface with itself are not looked for.
[[nodiscard]] Surface check_geometry(Surface surface, bool flip);

}  // namespace vesica::mesh
