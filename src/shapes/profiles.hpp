#pragma once

#include "revolution_mesh.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {

struct RevolutionProfile {
  Profile point;
  double meridian_length;  ///< from pole to pole
};

/// Parameter: arc length over the meridian's length.
[[nodiscard]] RevolutionProfile capsule_profile(const ShapeOptions& options);

/// Parameter: arc length weighted by (rho / sqrt(1 - s^2))^(-1/2), which keeps the triangles at the
/// waist, where the circumference is small, from becoming long and thin.
[[nodiscard]] RevolutionProfile peanut_profile(const ShapeOptions& options);

}  // namespace vesica::shapes
