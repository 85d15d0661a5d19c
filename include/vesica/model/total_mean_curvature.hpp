#pragma once

#include <cmath>
#include <string_view>

#include "vesica/model/surface_functional.hpp"
#include "vesica/model/target.hpp"

namespace vesica::model {

/// Total mean curvature int kappa, -8 pi R on a sphere. In the area-difference model it fixes the
/// difference of the areas of the two leaflets, h int kappa up to sign for leaflets h apart.
struct TotalMeanCurvature {
  static constexpr std::string_view name = "mean_curvature";
  static constexpr std::string_view key = "total_mean_curvature";
  static constexpr std::string_view unit = "length";
  static constexpr std::string_view meaning =
      "int kappa, negative where the vesicle is convex (-8 pi R of a sphere): as volume";
  static constexpr int length_power = 1;
  static constexpr bool needs_phase_field = false;
  static constexpr TargetKind default_target = TargetKind::free;
  static constexpr Curvature curvature = Curvature::mean;

  /// Returns the scale of its error, the square root of the area, since its target may be zero.
  static double error_scale(double area) { return std::sqrt(area); }

  template <class T>
  static T curvature_weight(const Material&, const T&) {
    return T(1.0);
  }
  template <class T>
  static T curvature_weight_derivative(const Material&, const T&) {
    return T(0.0);
  }

  template <class T>
  static T density(const Material&, const SurfacePoint<T>& p) {
    return p.mean_curvature;
  }

  /// Returns the first variation: a = |Q|^2 - kappa^2 = -2 g.
  template <class T>
  static Variation<T> variation(const Material&, const SurfacePoint<T>& p) {
    Variation<T> v;
    v.a = -2.0 * gaussian_curvature(p);
    return v;
  }
};

}  // namespace vesica::model
