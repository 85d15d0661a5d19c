#pragma once

#include <array>

namespace vesica::mesh {

/// The six shape functions of QuadraticTriangle, or one derivative of each, at a point. (fem has
/// its own; mesh may not include it.)
using ShapeFunctions = std::array<double, 6>;

constexpr ShapeFunctions shape_values(double u, double v) {
  const double w = 1 - u - v;
  return {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w};
}

constexpr ShapeFunctions shape_u(double u, double v) {
  const double w = 1 - u - v;
  return {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v};
}

constexpr ShapeFunctions shape_v(double u, double v) {
  const double w = 1 - u - v;
  return {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)};
}

}  // namespace vesica::mesh
