#pragma once

#include <cmath>
#include <numbers>

#include "vesica/model/two_phase.hpp"

namespace vesica::test {

/// int k_g(c) K on the ellipsoid of revolution x = a sin t, z = b cos t with c = (1 + cos t) / 2,
/// by the midpoint rule.
inline double exact_gaussian_energy(double a, double b, const model::PhasePair& k_g) {
  constexpr int count = 20000;
  const double pi = std::numbers::pi;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count * pi;
    const double s = std::hypot(a * std::cos(t), b * std::sin(t));
    const double curvature = b * b / std::pow(s, 4);
    const double weight = model::interpolate(k_g, 0.5 * (1 + std::cos(t)));
    sum += weight * curvature * a * std::sin(t) * s;
  }
  return sum * 2 * pi * pi / count;
}

/// int kappa of the prolate ellipsoid (a, a, b), e^2 = 1 - a^2 / b^2.
inline double exact_mean_curvature(double a, double b) {
  const double e = std::sqrt(1 - a * a / (b * b));
  return -4 * std::numbers::pi * (b + a * a / (2 * b * e) * std::log((1 + e) / (1 - e)));
}

}  // namespace vesica::test
