#pragma once

#include "shapes/formats/formats.hpp"

namespace vesica::shapes {

/// Smooths the vertices of flat triangles as Mending tells. Throws ConfigError for quadratic ones.
void smooth(SurfaceData& data, int passes);

}  // namespace vesica::shapes
