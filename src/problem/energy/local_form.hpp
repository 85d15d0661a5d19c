#pragma once

#include <array>

#include "vesica/fem/surface_element.hpp"
#include "vesica/model/model.hpp"

namespace vesica::problem {

/// Position and order parameter at a quadrature point with their derivatives along (u, v); also the
/// derivative of an integrand with respect to them.
template <class T>
struct PointFields {
  Vec3<T> x, x_u, x_v;  ///< position [length]
  T c{}, c_u{}, c_v{};  ///< order parameter
};

template <class T>
model::LocalPoint<T> local_point(const PointFields<T>& in, const fem::TangentFrame<T>& frame) {
  return {in.x, frame.normal, in.c, fem::surface_gradient(frame, in.c_u, in.c_v)};
}

/// Computes the derivative of N f, N = |n| with n = x_u x x_v the area element, from the partial
/// derivatives of f at `point`. With nu = n / N, P = I - nu nu^T, q = df/d(grad c) and q_u, q_v its
/// components along x_u, x_v,
///
///     N df = (f nu + P f_nu + extra) . dn + N (f_x . dx + f_c dc)
///            + N q_u (dc_u - grad c . dx_u) + N q_v (dc_v - grad c . dx_v);
///
/// `extra` is what further terms add to the derivative with respect to n.
template <class T>
PointFields<T> derivative_of(const model::LocalDensity<T>& f, const model::LocalPoint<T>& point,
                             const PointFields<T>& in, const fem::TangentFrame<T>& frame,
                             bool is_two_phase, const Vec3<T>& extra = {}) {
  const Vec3<T>& nu = frame.normal;
  const Vec3<T> by_n = (f.value - dot(f.by_normal, nu)) * nu + f.by_normal + extra;
  PointFields<T> out;
  out.x = frame.area_element * f.by_position;
  out.x_u = cross(in.x_v, by_n);
  out.x_v = cross(by_n, in.x_u);
  if (!is_two_phase) return out;
  out.c = frame.area_element * f.by_order_parameter;
  const Vec3<T> q = frame.area_element * f.by_order_parameter_gradient;
  out.c_u = dot(q, frame.dual_u);
  out.c_v = dot(q, frame.dual_v);
  out.x_u = out.x_u - out.c_u * point.order_parameter_gradient;
  out.x_v = out.x_v - out.c_v * point.order_parameter_gradient;
  return out;
}

/// Adds `factor` times each term of a list that has a density without curvature; the ones with a
/// form of their own are left to the caller.
template <class List, class T, class Factor>
void add_local_terms(const model::Physics& physics, const model::LocalPoint<T>& point,
                     const Factor& factor_of, model::LocalDensity<T>& sum) {
  model::for_each_term<List>([&]<class Term>(std::size_t place) {
    const double factor = factor_of(place);
    if constexpr (model::LocalTerm<Term>) {
      if (factor != 0 && model::takes_part<Term>(physics))
        Term::add_to(physics.material, point, factor, sum);
    }
  });
}

}  // namespace vesica::problem
