#pragma once

#include <cmath>

namespace vesica {

/// Vector in R^3 over a scalar or dual number, for the kernels at a quadrature point.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};
};

template <class T>
inline Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
inline Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
inline Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class S, class T>
inline Vec3<T> operator*(const S& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
inline T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
inline Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
inline T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// Symmetric 3 x 3 tensor, components in the order xx, yy, zz, xy, yz, xz.
template <class T>
struct Sym3 {
  T xx{}, yy{}, zz{}, xy{}, yz{}, xz{};
};

template <class T>
inline Vec3<T> operator*(const Sym3<T>& m, const Vec3<T>& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

/// Returns the square of the Frobenius norm, |m|^2.
template <class T>
inline T norm_squared(const Sym3<T>& m) {
  return m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2.0 * (m.xy * m.xy + m.yz * m.yz + m.xz * m.xz);
}

}  // namespace vesica
