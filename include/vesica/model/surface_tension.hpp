#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Energy of the surface int tau(c) with a tension tau for each phase. At fixed area and phase
/// difference it changes no shape: it lowers lambda_A by (tau_1 + tau_2)/2 and lambda_c by
/// (tau_1 - tau_2)/2.
struct SurfaceTension {
  static constexpr std::string_view name = "surface_tension";
  static constexpr bool needs_phase_field = false;

  /// Tells whether a tension is not zero; without one the term is left out.
  static bool is_present(const Material& m) {
    return m.surface_tension.phase_1 != 0 || m.surface_tension.phase_2 != 0;
  }

  template <class T>
  static void add_to(const Material& m, const LocalPoint<T>& p, double factor,
                     LocalDensity<T>& sum) {
    sum.value += factor * interpolate(m.surface_tension, p.order_parameter);
    sum.by_order_parameter += factor * interpolate_derivative(m.surface_tension, p.order_parameter);
  }
};

}  // namespace vesica::model
