#pragma once

#include <concepts>

#include "vesica/core/small_tensor.hpp"
#include "vesica/model/material.hpp"

namespace vesica::model {

/// Values at one point of the surface for functionals that do not depend on the curvature.
/// Gradients are surface gradients in R^3.
template <class T>
struct LocalPoint {
  Vec3<T> position;                  ///< x [length]
  Vec3<T> normal;                    ///< nu, outward unit normal
  T order_parameter;                 ///< c, +1 in phase 1
  Vec3<T> order_parameter_gradient;  ///< grad c [1/length]
};

/// Values at one point of the surface for functionals that depend on the curvature too.
template <class T>
struct SurfacePoint : LocalPoint<T> {
  T mean_curvature;                 ///< kappa = -div nu, -2/R on a sphere [1/length]
  Vec3<T> mean_curvature_gradient;  ///< grad kappa [1/length^2]
  Sym3<T> shape_operator;           ///< Q = grad nu, +1/R P on a sphere [1/length]
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

  /// Adds `factor` times another variation.
  template <class Factor>
  void add(const Factor& factor, const Variation& term) {
    a = a + factor * term.a;
    b = b + factor * term.b;
    s = s + factor * term.s;
    q = q + factor * term.q;
  }
};

/// A density f(x, nu, c, grad c) that does not depend on the curvature, and its partial
/// derivatives. All formulations take what they need from these five.
template <class T>
struct LocalDensity {
  T value{};                              ///< f
  T by_order_parameter{};                 ///< df/dc
  Vec3<T> by_order_parameter_gradient{};  ///< df/d(grad c), tangential [density * length]
  Vec3<T> by_position{};                  ///< df/dx [density/length]
  Vec3<T> by_normal{};                    ///< df/dnu
};

/// Returns the first variation of a density that does not depend on the curvature, P = I - nu nu^T:
///
///     a = -f kappa - f_grad . Q grad c + f_x . nu,   b = -P f_nu,   s = f_c,   q = f_grad.
template <class T>
Variation<T> variation_of(const LocalDensity<T>& f, const SurfacePoint<T>& p) {
  const Vec3<T>& q = f.by_order_parameter_gradient;
  Variation<T> v;
  v.a = dot(f.by_position, p.normal) - f.value * p.mean_curvature -
        dot(q, p.shape_operator * p.order_parameter_gradient);
  v.b = dot(f.by_normal, p.normal) * p.normal - f.by_normal;
  v.s = f.by_order_parameter;
  v.q = q;
  return v;
}

/// A term of `Energies` or `Constraints` that does not depend on the curvature. It adds `factor`
/// times itself to a density. One that looks at the curvature does not satisfy this: a LocalPoint
/// has none.
template <class Term>
concept LocalTerm = requires(const Material& material, const LocalPoint<double>& point,
                             LocalDensity<double>& sum) {
  Term::add_to(material, point, 1.0, sum);
};

/// A term that gives its first variation itself, as (2.6a), (2.6b) and (2.6d) after integration by
/// parts. The other terms take `variation_of` their density.
template <class Term>
concept HasVariation = requires(const Material& material, const SurfacePoint<double>& point) {
  { Term::variation(material, point) } -> std::same_as<Variation<double>>;
};

/// The curvatures that a surface of quadratic elements has as distributions: inside the elements
/// and concentrated at their edges (and corners).
enum class Curvature { gauss, mean };

/// A term int s(c) K or int s(c) kappa. The discrete functional is sum_i s(c_i) int phi_i dK, with
/// `curvature_weight` s and its derivative.
template <class Term>
concept CurvatureTerm = requires(const Material& material) {
  { Term::curvature } -> std::convertible_to<Curvature>;
  Term::curvature_weight(material, 1.0);
  Term::curvature_weight_derivative(material, 1.0);
};

/// Returns the density of a term at a point.
template <class Term, class T>
T density_of(const Material& material, const SurfacePoint<T>& point) {
  if constexpr (LocalTerm<Term>) {
    LocalDensity<T> f;
    Term::add_to(material, static_cast<const LocalPoint<T>&>(point), 1.0, f);
    return f.value;
  } else {
    return Term::density(material, point);
  }
}

/// Returns the first variation of a term at a point.
template <class Term, class T>
Variation<T> variation_of_term(const Material& material, const SurfacePoint<T>& point) {
  if constexpr (HasVariation<Term>) {
    return Term::variation(material, point);
  } else {
    static_assert(LocalTerm<Term>, "a term needs add_to(), or density() and variation()");
    LocalDensity<T> f;
    Term::add_to(material, static_cast<const LocalPoint<T>&>(point), 1.0, f);
    return variation_of(f, point);
  }
}

/// Returns |Q|^2 = |grad nu|^2 = kappa_1^2 + kappa_2^2 [1/length^2].
template <class T>
T shape_operator_squared(const SurfacePoint<T>& p) {
  return norm_squared(p.shape_operator);
}

/// Returns the Gaussian curvature g = (kappa^2 - |Q|^2) / 2 [1/length^2].
template <class T>
T gaussian_curvature(const SurfacePoint<T>& p) {
  return 0.5 * (p.mean_curvature * p.mean_curvature - shape_operator_squared(p));
}

}  // namespace vesica::model
