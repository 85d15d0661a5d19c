#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Ginzburg-Landau energy int sigma (eps/2 |grad c|^2 + psi(c)/eps) (1.3); tends to 4/3 sigma times
/// the length of the interface (1.4).
struct LineEnergy {
  static constexpr std::string_view name = "line";
  static constexpr bool needs_phase_field = true;

  template <class T>
  static T density(const Material& m, const SurfacePoint<T>& p) {
    const Vec3<T>& gradient = p.order_parameter_gradient;
    return m.line_tension * (0.5 * m.interface_width * dot(gradient, gradient) +
                             (1 / m.interface_width) * double_well(p.order_parameter));
  }

  /// (2.6c), with the Laplacian of c integrated by parts.
  template <class T>
  static Variation<T> variation(const Material& m, const SurfacePoint<T>& p) {
    const double sigma_eps = m.line_tension * m.interface_width;
    const Vec3<T>& gradient = p.order_parameter_gradient;
    Variation<T> v;
    v.a =
        -sigma_eps * dot(gradient, p.shape_operator * gradient) - density(m, p) * p.mean_curvature;
    v.s = (m.line_tension / m.interface_width) * double_well_derivative(p.order_parameter);
    v.q = sigma_eps * gradient;
    return v;
  }
};

}  // namespace vesica::model
