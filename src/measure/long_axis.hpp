#pragma once

#include <Eigen/Core>

#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// Long axis of a surface and its extent there.
struct LongAxis {
  Eigen::Vector3d direction;  ///< unit vector
  double low = 0;             ///< smallest x . direction on the quadratic surface [length]
  double high = 0;            ///< largest [length]
  bool is_unique = false;     ///< false for spheres, oblates and the like
};

/// The principal axis of largest variance of the surface, int (x - x_0)(x - x_0)^T. Where the two
/// largest variances agree to 1 %, no axis is preferred and the direction of largest extent is
/// taken instead.
[[nodiscard]] LongAxis long_axis(const problem::State& state);

}  // namespace vesica::measure
