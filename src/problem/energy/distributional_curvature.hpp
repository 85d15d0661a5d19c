#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "vesica/core/dual.hpp"
#include "vesica/core/small_tensor.hpp"
#include "vesica/fem/quadrature.hpp"

namespace vesica::problem {

/// Arguments of a distributional curvature of an element at a point: a weight s of the curvature
/// and the derivatives of the position along (u, v); also the derivative of an integrand with
/// respect to them.
template <class T>
struct CurvaturePoint {
  T s{};
  Vec3<T> x_u, x_v, x_uu, x_uv, x_vv;
  Vec3<ValueOf<T>> normal{};  ///< the direction from which the angles at edges are counted
};

/// A direction in the reference triangle.
struct Direction {
  double u = 0;
  double v = 0;
};

/// An integrand and its derivative.
template <class T>
struct CurvatureIntegrand {
  T value{};
  CurvaturePoint<T> gradient;
};

/// Returns the angle of the plane vector (cosine, sine), whose length may be any, as a number of
/// type T: its derivative is (cos d sin - sin d cos) / (cos^2 + sin^2).
template <class T>
T angle_of(const T& sine, const T& cosine) {
  using std::atan2;
  const auto s = value_of(sine);
  const auto c = value_of(cosine);
  return T(atan2(s, c)) +
         T(1.0 / (s * s + c * c)) * (T(c) * (sine - T(s)) - T(s) * (cosine - T(c)));
}

/// Computes s K times the area element N, K = det b / det g the Gauss curvature inside the element.
template <class T>
CurvatureIntegrand<T> interior_gauss_curvature(const CurvaturePoint<T>& in) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T area_squared = dot(n, n);
  using std::sqrt;
  const T cubed = area_squared * sqrt(area_squared);
  const T uu = dot(n, in.x_uu);
  const T uv = dot(n, in.x_uv);
  const T vv = dot(n, in.x_vv);
  const T scale = in.s / cubed;
  const T density = (uu * vv - uv * uv) / cubed;
  const Vec3<T> by_normal = scale * (vv * in.x_uu + uu * in.x_vv - 2.0 * (uv * in.x_uv)) -
                            (3.0 * in.s * density / area_squared) * n;
  CurvatureIntegrand<T> out;
  out.value = in.s * density;
  out.gradient.s = density;
  out.gradient.x_uu = (scale * vv) * n;
  out.gradient.x_uv = (-2.0 * scale * uv) * n;
  out.gradient.x_vv = (scale * uu) * n;
  out.gradient.x_u = cross(in.x_v, by_normal);
  out.gradient.x_v = cross(by_normal, in.x_u);
  return out;
}

/// Computes s kappa_g times the line element along an edge whose parameter runs in the direction
/// `d`, counter-clockwise: nu . (x_t x x_tt) / |x_t|^2.
template <class T>
CurvatureIntegrand<T> geodesic_curvature(const CurvaturePoint<T>& in, const Direction& d) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T area = norm(n);
  const Vec3<T> nu = (1.0 / area) * n;
  const Vec3<T> t = d.u * in.x_u + d.v * in.x_v;
  const Vec3<T> tt = (d.u * d.u) * in.x_uu + (2 * d.u * d.v) * in.x_uv + (d.v * d.v) * in.x_vv;
  const Vec3<T> r = cross(t, tt);
  const T inverse = 1.0 / dot(t, t);
  const T along = dot(nu, r);
  const T scale = in.s * inverse;
  const Vec3<T> by_normal = (scale / area) * (r - along * nu);
  const Vec3<T> by_t = scale * cross(tt, nu) - (2.0 * scale * along * inverse) * t;
  const Vec3<T> by_tt = scale * cross(nu, t);
  CurvatureIntegrand<T> out;
  out.value = scale * along;
  out.gradient.s = along * inverse;
  out.gradient.x_u = cross(in.x_v, by_normal) + d.u * by_t;
  out.gradient.x_v = cross(by_normal, in.x_u) + d.v * by_t;
  out.gradient.x_uu = (d.u * d.u) * by_tt;
  out.gradient.x_uv = (2 * d.u * d.v) * by_tt;
  out.gradient.x_vv = (d.v * d.v) * by_tt;
  return out;
}

/// Computes -s times the inner angle at a corner, between the tangents of its two edges: `a` of the
/// next edge and `b` back along the previous one.
template <class T>
CurvatureIntegrand<T> corner_angle(const CurvaturePoint<T>& in, const Direction& a,
                                   const Direction& b) {
  const Vec3<T> first = a.u * in.x_u + a.v * in.x_v;
  const Vec3<T> second = b.u * in.x_u + b.v * in.x_v;
  const Vec3<T> n = cross(first, second);
  const T sine = norm(n);
  const T cosine = dot(first, second);
  const Vec3<T> axis = (1.0 / sine) * n;
  const Vec3<T> by_first = (-1.0 / dot(first, first)) * cross(axis, first);
  const Vec3<T> by_second = (1.0 / dot(second, second)) * cross(axis, second);
  const T angle = angle_of(sine, cosine);
  CurvatureIntegrand<T> out;
  out.value = -(in.s * angle);
  out.gradient.s = -angle;
  out.gradient.x_u = -(in.s * (a.u * by_first + b.u * by_second));
  out.gradient.x_v = -(in.s * (a.v * by_first + b.v * by_second));
  return out;
}

/// Computes s kappa times the area element, kappa = tr(g^-1 b) = -2/R on a sphere.
template <class T>
CurvatureIntegrand<T> interior_mean_curvature(const CurvaturePoint<T>& in) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const T inverse = 1.0 / dot(n, n);
  const T uu = dot(n, in.x_uu);
  const T uv = dot(n, in.x_uv);
  const T vv = dot(n, in.x_vv);
  const T g_uu = dot(in.x_u, in.x_u);
  const T g_uv = dot(in.x_u, in.x_v);
  const T g_vv = dot(in.x_v, in.x_v);
  const T density = inverse * (g_vv * uu - 2.0 * (g_uv * uv) + g_uu * vv);
  const T scale = in.s * inverse;
  const Vec3<T> by_normal = scale * (g_vv * in.x_uu - 2.0 * (g_uv * in.x_uv) + g_uu * in.x_vv) -
                            (2.0 * scale * density) * n;
  CurvatureIntegrand<T> out;
  out.value = in.s * density;
  out.gradient.s = density;
  out.gradient.x_uu = (scale * g_vv) * n;
  out.gradient.x_uv = (-2.0 * scale * g_uv) * n;
  out.gradient.x_vv = (scale * g_uu) * n;
  out.gradient.x_u = cross(in.x_v, by_normal) + (2.0 * scale) * (vv * in.x_u - uv * in.x_v);
  out.gradient.x_v = cross(by_normal, in.x_u) + (2.0 * scale) * (uu * in.x_v - uv * in.x_u);
  return out;
}

/// Computes this element's share of the curvature that is concentrated along an edge, -s times the
/// angle between the two faces, positive where the edge is convex, times the line element. The
/// share is the angle from the normal of the element to the direction m that both elements have
/// there, turned about the tangent t towards the outside of the element: atan2(m . (t x n), |t| m .
/// n). The sum of both does not depend on m, which therefore is not differentiated.
template <class T>
CurvatureIntegrand<T> edge_angle(const CurvaturePoint<T>& in, const Direction& d) {
  const Vec3<T> n = cross(in.x_u, in.x_v);
  const Vec3<T> t = d.u * in.x_u + d.v * in.x_v;
  const Vec3<T> m{in.normal.x, in.normal.y, in.normal.z};
  const T length = norm(t);
  const T along_normal = dot(m, n);
  const T sine = dot(m, cross(t, n));
  const T cosine = length * along_normal;
  const T angle = angle_of(sine, cosine);
  const T scale = -(in.s * length) / (sine * sine + cosine * cosine);
  const T by_length = -(in.s * angle) - scale * sine * along_normal;
  const Vec3<T> by_t = (by_length / length) * t + (scale * cosine) * cross(n, m);
  const Vec3<T> by_normal = (scale * cosine) * cross(m, t) - (scale * sine * length) * m;
  CurvatureIntegrand<T> out;
  out.value = -(in.s * angle * length);
  out.gradient.s = -(angle * length);
  out.gradient.x_u = cross(in.x_v, by_normal) + d.u * by_t;
  out.gradient.x_v = cross(by_normal, in.x_u) + d.v * by_t;
  return out;
}

/// Directions along the edges 0-1, 1-2, 2-0.
inline constexpr std::array<Direction, 3> edge_directions{{{1, 0}, {-1, 1}, {0, -1}}};

/// Points of the three edges, 4-point Gauss rule, weights for a parameter in [0, 1].
struct EdgePoint {
  fem::ShapeValues shape;
  Direction direction;
  double weight = 0;
};

inline std::array<EdgePoint, 12> edge_rule() {
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
  const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double root = std::sqrt(30.0);
  const std::array<std::array<double, 2>, 4> points{{{-outer, (18 - root) / 72},
                                                     {-inner, (18 + root) / 72},
                                                     {inner, (18 + root) / 72},
                                                     {outer, (18 - root) / 72}}};
  constexpr std::array<Direction, 3> starts{{{0, 0}, {1, 0}, {0, 1}}};
  std::array<EdgePoint, 12> rule;
  std::size_t next = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const auto& d = edge_directions[e];
    for (const auto& [x, weight] : points) {
      const double t = 0.5 * (1 + x);
      rule[next++] = {fem::shape_values(starts[e].u + t * d.u, starts[e].v + t * d.v), d, weight};
    }
  }
  return rule;
}

/// A corner of an element: its shape functions and the directions of its edges.
struct CornerPoint {
  fem::ShapeValues shape;
  Direction next;
  Direction previous;
};

inline std::array<CornerPoint, 3> corner_rule() {
  return {{{fem::shape_values(0, 0), {1, 0}, {0, 1}},
           {fem::shape_values(1, 0), {-1, 1}, {-1, 0}},
           {fem::shape_values(0, 1), {0, -1}, {1, -1}}}};
}

}  // namespace vesica::problem
