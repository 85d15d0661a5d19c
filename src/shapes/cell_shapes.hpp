#pragma once

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Reduced volumes that the two shapes can have.
inline constexpr double least_discocyte = 0.58;
inline constexpr double least_stomatocyte = 0.2;
inline constexpr double most_stomatocyte = 0.72;

/// Places the nodes of a unit sphere on a discocyte or stomatocyte around z, as make_shape
/// describes them; `radius` is that of the sphere with the same area.
[[nodiscard]] mesh::Surface discocyte(mesh::Surface sphere, double reduced_volume, double radius);
[[nodiscard]] mesh::Surface stomatocyte(mesh::Surface sphere, double reduced_volume, double radius);

}  // namespace vesica::shapes
