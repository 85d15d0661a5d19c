#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Ginzburg-Landau energy int sigma (eps/2 |grad c|^2 + psi(c)/eps) (1.3); tends to 4/3 sigma times
/// the length of the interface (1.4). Its variation is (2.6c), with the Laplacian of c integrated
/// by parts.
struct LineEnergy {
  static constexpr std::string_view name = "line";
  static constexpr bool needs_phase_field = true;

  template <class T>
  static void add_to(const Material& m, const LocalPoint<T>& p, double factor,
                     LocalDensity<T>& sum) {
    const double sigma = factor * m.line_tension;
    const double eps = m.interface_width;
    const Vec3<T> q = (sigma * eps) * p.order_parameter_gradient;
    sum.value +=
        0.5 * dot(q, p.order_parameter_gradient) + (sigma / eps) * double_well(p.order_parameter);
    sum.by_order_parameter += (sigma / eps) * double_well_derivative(p.order_parameter);
    sum.by_order_parameter_gradient = sum.by_order_parameter_gradient + q;
  }
};

}  // namespace vesica::model
