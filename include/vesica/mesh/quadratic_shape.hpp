#pragma once

#include <array>

namespace vesica::mesh {

/// Values and derivatives of the six shape functions at one point of the reference triangle (node
/// order of QuadraticTriangle).
struct ShapeValues {
  std::array<double, 6> value{};
  std::array<double, 6> du{};
  std::array<double, 6> dv{};
};

/// Computes the shape functions and their derivatives at (u, v).
[[nodiscard]] constexpr ShapeValues shape_values(double u, double v) {
  const double w = 1 - u - v;
  ShapeValues s;
  s.value = {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w};
  s.du = {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v};
  s.dv = {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)};
  return s;
}

}  // namespace vesica::mesh
