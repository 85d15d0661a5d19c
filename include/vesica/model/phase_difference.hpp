#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Phase difference int h(c) of (2.2), which tends to A_1 - A_2.
struct PhaseDifference {
  static constexpr std::string_view name = "phase";
  static constexpr bool needs_phase_field = true;

  template <class T>
  static T density(const SurfacePoint<T>& p) {
    return phase_indicator(p.order_parameter);
  }

  /// (2.6f).
  template <class T>
  static Variation<T> variation(const SurfacePoint<T>& p) {
    Variation<T> v;
    v.a = -(phase_indicator(p.order_parameter) * p.mean_curvature);
    v.s = phase_indicator_derivative(p.order_parameter);
    return v;
  }
};

}  // namespace vesica::model
