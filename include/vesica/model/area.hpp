#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"

namespace vesica::model {

/// Surface area |Gamma| of (2.2).
struct Area {
  static constexpr std::string_view name = "area";
  static constexpr bool needs_phase_field = false;

  template <class T>
  static T density(const SurfacePoint<T>&) {
    return T(1.0);
  }

  /// (2.6e).
  template <class T>
  static Variation<T> variation(const SurfacePoint<T>& p) {
    Variation<T> v;
    v.a = -p.mean_curvature;
    return v;
  }
};

}  // namespace vesica::model
