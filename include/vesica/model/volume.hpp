#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"

namespace vesica::model {

/// Enclosed volume 1/3 int x . nu (2.3).
struct Volume {
  static constexpr std::string_view name = "volume";
  static constexpr std::string_view key = "volume";
  static constexpr std::string_view unit = "length^3";
  static constexpr std::string_view meaning =
      "number, [from, to, t0, t1], { times, values, kind = \"linear\" or \"stages\" }, \"initial\" "
      "(also as the first value) or \"free\"";
  static constexpr int length_power = 3;
  static constexpr bool needs_phase_field = false;

  template <class T, class Factor>
  static void add_to(const Material&, const LocalPoint<T>& p, const Factor& factor,
                     LocalDensity<T>& sum) {
    const auto third = factor * (1.0 / 3.0);
    sum.value += third * dot(p.position, p.normal);
    sum.by_position = sum.by_position + third * p.normal;
    sum.by_normal = sum.by_normal + third * p.position;
  }

  /// Returns the first variation (2.6d), integrated by parts: a = 1.
  template <class T>
  static Variation<T> variation(const Material&, const SurfacePoint<T>&) {
    Variation<T> v;
    v.a = T(1.0);
    return v;
  }
};

}  // namespace vesica::model
