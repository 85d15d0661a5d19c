#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Mean-curvature energy int k_kappa(c)/2 (kappa - kappa_s(c))^2, first term of (1.6).
struct BendingEnergy {
  static constexpr std::string_view name = "bending";
  static constexpr bool needs_phase_field = false;

  template <class T>
  static T density(const Material& m, const SurfacePoint<T>& p) {
    const T difference = p.mean_curvature - interpolate(m.spontaneous_curvature, p.order_parameter);
    return 0.5 * interpolate(m.bending_rigidity, p.order_parameter) * difference * difference;
  }

  /// Returns the first variation (2.6a), with int Delta(k (kappa - kappa_s)) w integrated by parts
  /// into b = -grad(k (kappa - kappa_s)).
  template <class T>
  static Variation<T> variation(const Material& m, const SurfacePoint<T>& p) {
    const T& c = p.order_parameter;
    const T k = interpolate(m.bending_rigidity, c);
    const T k_prime = interpolate_derivative(m.bending_rigidity, c);
    const T curvature_prime = interpolate_derivative(m.spontaneous_curvature, c);
    const T difference = p.mean_curvature - interpolate(m.spontaneous_curvature, c);
    const T moment = k * difference;
    const T moment_prime = k_prime * difference - k * curvature_prime;  // d moment / dc
    Variation<T> v;
    v.a = moment * (shape_operator_squared(p) - 0.5 * difference * p.mean_curvature);
    v.b = -(k * p.mean_curvature_gradient) - moment_prime * p.order_parameter_gradient;
    v.s = difference * (0.5 * difference * k_prime - k * curvature_prime);
    return v;
  }
};

}  // namespace vesica::model
