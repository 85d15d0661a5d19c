#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::model {

/// Phase difference int h(c) of (2.2), which tends to A_1 - A_2; its variation is (2.6f).
struct PhaseDifference {
  static constexpr std::string_view name = "phase";
  static constexpr std::string_view key = "phase_difference";
  static constexpr std::string_view unit = "length^2";
  static constexpr std::string_view meaning = "A_1 - A_2: as volume";
  static constexpr int length_power = 2;
  static constexpr bool needs_phase_field = true;

  /// Returns the scale of its error, the area, since its target may be zero.
  static double error_scale(double area) { return area; }

  template <class T, class Factor>
  static void add_to(const Material&, const LocalPoint<T>& p, const Factor& factor,
                     LocalDensity<T>& sum) {
    sum.value += factor * phase_indicator(p.order_parameter);
    sum.by_order_parameter += factor * phase_indicator_derivative(p.order_parameter);
  }
};

}  // namespace vesica::model
