#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"

namespace vesica::model {

/// Enclosed volume 1/3 int x . nu (2.3).
struct Volume {
  static constexpr std::string_view name = "volume";
  static constexpr bool needs_phase_field = false;

  template <class T>
  static T density(const SurfacePoint<T>& p) {
    return (1.0 / 3.0) * dot(p.position, p.normal);
  }

  /// (2.6d).
  template <class T>
  static Variation<T> variation(const SurfacePoint<T>&) {
    Variation<T> v;
    v.a = T(1.0);
    return v;
  }
};

}  // namespace vesica::model
