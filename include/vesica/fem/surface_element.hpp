#pragma once

#include <array>

#include "vesica/core/small_tensor.hpp"
#include "vesica/fem/quadratic_triangle.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::fem {

/// Metric data of a parametrised surface at a point.
template <class T>
struct TangentFrame {
  Vec3<T> normal;  ///< nu = x_u x x_v / |x_u x x_v|, outward
  T area_element;  ///< |x_u x x_v|
  Vec3<T> dual_u;  ///< x^u with x^u . x_u = 1, x^u . x_v = 0, tangential
  Vec3<T> dual_v;  ///< x^v
};

template <class T>
/// Computes the metric data from the derivatives of x along the two parameters.
TangentFrame<T> tangent_frame(const Vec3<T>& x_u, const Vec3<T>& x_v) {
  using std::sqrt;
  const Vec3<T> n = cross(x_u, x_v);
  const T squared = dot(n, n);
  const T area_element = sqrt(squared);
  const T inverse = 1.0 / area_element;
  const T inverse_squared = inverse * inverse;
  return {inverse * n, area_element, inverse_squared * cross(x_v, n),
          inverse_squared * cross(n, x_u)};
}

/// Returns the surface gradient from the derivatives along the two parameters: f_u x^u + f_v x^v.
template <class S, class T>
Vec3<T> surface_gradient(const TangentFrame<T>& frame, const S& f_u, const S& f_v) {
  return f_u * frame.dual_u + f_v * frame.dual_v;
}

/// Returns the shape operator grad nu = -b_ij x^i (x) x^j of the element itself, b the second
/// fundamental form; +1/R P on a sphere.
template <class T>
Sym3<T> element_shape_operator(const TangentFrame<T>& frame, const Vec3<T>& x_uu,
                               const Vec3<T>& x_uv, const Vec3<T>& x_vv) {
  const T uu = dot(frame.normal, x_uu);
  const T uv = dot(frame.normal, x_uv);
  const T vv = dot(frame.normal, x_vv);
  // -(p (x) x^u + q (x) x^v), symmetric by construction
  const Vec3<T>& a = frame.dual_u;
  const Vec3<T>& b = frame.dual_v;
  const Vec3<T> p = uu * a + uv * b;
  const Vec3<T> q = uv * a + vv * b;
  return {-(p.x * a.x + q.x * b.x), -(p.y * a.y + q.y * b.y), -(p.z * a.z + q.z * b.z),
          -(p.x * a.y + q.x * b.y), -(p.y * a.z + q.y * b.z), -(p.x * a.z + q.x * b.z)};
}

/// Returns sum_i weights[i] field[i] over the six nodes of a triangle, for fields stored a row a
/// node.
template <int Columns, class Field>
std::array<double, Columns> combine(const Field& field, const mesh::QuadraticTriangle& triangle,
                                    const std::array<double, 6>& weights) {
  std::array<double, Columns> sum{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (int k = 0; k < Columns; ++k) {
      sum[static_cast<std::size_t>(k)] += weights[i] * field(triangle[i], k);
    }
  }
  return sum;
}

inline Vec3<double> to_vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace vesica::fem
