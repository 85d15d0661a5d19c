#pragma once

#include "vesica/core/dual.hpp"
#include "vesica/model/material.hpp"

namespace vesica::model {

/// Returns h(c) = c (3 - c^2) / 2 between -1 and 1, and -1 or 1 outside (Section 2.1).
template <class T>
T phase_indicator(const T& c) {
  const T x = clamped(c);
  return 0.5 * x * (3.0 - x * x);
}

/// Returns h'(c) = 3/2 (1 - c^2) between -1 and 1, 0 outside.
template <class T>
T phase_indicator_derivative(const T& c) {
  const T x = clamped(c);
  return 1.5 * (1.0 - x * x);
}

/// Returns the double well psi(c) = (1 - c^2)^2 / 2 of (1.3).
template <class T>
T double_well(const T& c) {
  const T u = 1.0 - c * c;
  return 0.5 * u * u;
}

/// Returns psi'(c) = -2 c (1 - c^2).
template <class T>
T double_well_derivative(const T& c) {
  return -2.0 * c * (1.0 - c * c);
}

/// Returns the material constant interpolated between the phases by (1.5): (k1 + k2)/2 + (k1 -
/// k2)/2 h(c).
template <class T>
T interpolate(const PhasePair& k, const T& c) {
  if (k.phase_1 == k.phase_2) return T(k.phase_1);
  return 0.5 * (k.phase_1 + k.phase_2) + (0.5 * k.difference()) * phase_indicator(c);
}

/// Returns the derivative of `interpolate` in c.
template <class T>
T interpolate_derivative(const PhasePair& k, const T& c) {
  if (k.phase_1 == k.phase_2) return T(0.0);
  return (0.5 * k.difference()) * phase_indicator_derivative(c);
}

}  // namespace vesica::model
