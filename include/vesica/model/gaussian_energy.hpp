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

  static constexpr Curvature curvature = Curvature::gauss;

  /// Tells whether the energy is 2 pi chi times the mean rigidity on every closed surface.
  static bool is_topological(const Material& m) { return m.gaussian_rigidity.difference() == 0; }
  /// Returns the part of k_g that multiplies 2 pi chi: the mean of the phases.
  static double topological_rigidity(const Material& m, bool is_two_phase) {
    const auto& k_g = m.gaussian_rigidity;
    return is_two_phase ? 0.5 * (k_g.phase_1 + k_g.phase_2) : k_g.phase_1;
  }
  /// Returns the rest of k_g(c).
  template <class T>
  static T curvature_weight(const Material& m, const T& c) {
    return (0.5 * m.gaussian_rigidity.difference()) * phase_indicator(c);
  }
  template <class T>
  static T curvature_weight_derivative(const Material& m, const T& c) {
    return (0.5 * m.gaussian_rigidity.difference()) * phase_indicator_derivative(c);
  }

  template <class T>
  static T density(const Material& m, const SurfacePoint<T>& p) {
    return interpolate(m.gaussian_rigidity, p.order_parameter) * gaussian_curvature(p);
  }

  /// Returns the first variation (2.6b), integrated by parts. It is zero for equal rigidities: the
  /// energy is then topological.
  template <class T>
  static Variation<T> variation(const Material& m, const SurfacePoint<T>& p) {
    if (is_topological(m)) return {};
    const T k_prime = interpolate_derivative(m.gaussian_rigidity, p.order_parameter);
    const Vec3<T>& gradient = p.order_parameter_gradient;
    Variation<T> v;
    v.b = -(k_prime * (p.mean_curvature * gradient + p.shape_operator * gradient));
    v.s = k_prime * gaussian_curvature(p);
    return v;
  }
};

}  // namespace vesica::model
