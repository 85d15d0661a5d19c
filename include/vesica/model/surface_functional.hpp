#pragma once

#include "vesica/core/small_tensor.hpp"

namespace vesica::model {

/// What a functional sees at one point of the surface. Gradients are surface gradients in R^3.
template <class T>
struct SurfacePoint {
  Vec3<T> position;                  ///< x [length]
  Vec3<T> normal;                    ///< nu, outward unit normal
  T mean_curvature;                  ///< kappa = -div nu, -2/R on a sphere [1/length]
  Vec3<T> mean_curvature_gradient;   ///< grad kappa [1/length^2]
  Sym3<T> shape_operator;            ///< Q = grad nu, +1/R P on a sphere [1/length]
  T order_parameter;                 ///< c, +1 in phase 1
  Vec3<T> order_parameter_gradient;  ///< grad c [1/length]
};

/// First variation of int density at a point, in the form all terms of (2.6) take after integration
/// by parts:
///
///     <dF, (w nu, eta)> = int a w + b . grad w + s eta + q . grad eta
///
/// for a normal displacement w nu and a change eta of c along it.
template <class T>
struct Variation {
  T a{};        ///< [density/length]
  Vec3<T> b{};  ///< [density]
  T s{};        ///< [density]
  Vec3<T> q{};  ///< [density * length]
};

/// |Q|^2 = |grad nu|^2 = kappa_1^2 + kappa_2^2 [1/length^2].
template <class T>
T shape_operator_squared(const SurfacePoint<T>& p) {
  return norm_squared(p.shape_operator);
}

/// Gaussian curvature g = (kappa^2 - |Q|^2) / 2 [1/length^2].
template <class T>
T gaussian_curvature(const SurfacePoint<T>& p) {
  return 0.5 * (p.mean_curvature * p.mean_curvature - shape_operator_squared(p));
}

}  // namespace vesica::model
