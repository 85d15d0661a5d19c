#pragma once

#include <span>

#include "vesica/fem/quadratic_triangle.hpp"

namespace vesica::fem {

/// A point of the rule with its weight; the weights sum to 1/2, the area of the reference triangle.
struct QuadraturePoint {
  double u = 0;
  double v = 0;
  double weight = 0;
  ShapeValues shape;
};

/// Returns the points of the one quadrature rule of the library: 7 points, exact for polynomials of
/// degree 5 (Radon 1948), symmetric, positive weights. Residual, Jacobian, energies and constraints
/// all use it: with different rules Newton's method fails.
[[nodiscard]] std::span<const QuadraturePoint> triangle_rule();

}  // namespace vesica::fem
