#pragma once

#include <array>

#include "vesica/mesh/quadratic_shape.hpp"

namespace vesica::fem {

using mesh::shape_values;
using mesh::ShapeValues;

/// Second derivatives of the six shape functions, constant over the element.
struct ShapeSecondDerivatives {
  std::array<double, 6> duu{};
  std::array<double, 6> duv{};
  std::array<double, 6> dvv{};
};

/// Returns the second derivatives of the shape functions.
[[nodiscard]] constexpr ShapeSecondDerivatives shape_second_derivatives() {
  return {{4, 4, 0, -8, 0, 0}, {4, 0, 0, -4, 4, -4}, {4, 0, 4, 0, 0, -8}};
}

}  // namespace vesica::fem
