#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Gaussian energy int k_g(c) g with g = (kappa^2 - |Q|^2)/2, second term of (1.6). (4.3) of the
/// paper lacks the 1/2.
struct GaussianEnergy {
  static constexpr std::string_view name = "gaussian";
  static constexpr bool needs_phase_field = false;

  template <class T>
  static T density(const Material& m, const SurfacePoint<T>& p) {
    return interpolate(m.gaussian_rigidity, p.order_parameter) * gaussian_curvature(p);
  }

  /// Returns the first variation (2.6b), integrated by parts. It is zero for equal rigidities: the
  /// energy is then topological.
  template <class T>
  static Variation<T> variation(const Material& m, const SurfacePoint<T>& p) {
    if (m.gaussian_rigidity.phase_1 == m.gaussian_rigidity.phase_2) return {};
    const T k_prime = interpolate_derivative(m.gaussian_rigidity, p.order_parameter);
    const Vec3<T>& gradient = p.order_parameter_gradient;
    Variation<T> v;
    v.b = -(k_prime * (p.mean_curvature * gradient + p.shape_operator * gradient));
    v.s = k_prime * gaussian_curvature(p);
    return v;
  }
};

}  // namespace vesica::model
