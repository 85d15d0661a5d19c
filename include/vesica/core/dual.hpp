#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <utility>

namespace vesica {

/// Forward-mode dual number: a value and its derivatives with respect to N inputs. Arithmetic
/// carries exact derivatives; the loops have fixed length, so compilers turn them into vector
/// instructions. `Real` is double, or a number that stands for several.
template <int N, class Real = double>
struct Dual {
  Real value{};
  alignas(N % 8 == 0 ? 64 : 16) alignas(Real) std::array<Real, N> derivatives{};

  Dual() = default;
  // Implicit, so that constants mix with dual numbers in formulas.
  template <std::convertible_to<Real> Constant>
  Dual(Constant constant) : value(constant) {}

  /// Makes the input number `index`, with derivative 1 in its own direction.
  [[nodiscard]] static Dual input(Real value, int index) {
    Dual result(value);
    result.derivatives[static_cast<std::size_t>(index)] = 1;
    return result;
  }

  /// Returns f(this) by the chain rule, from f and f' at the value.
  [[nodiscard]] Dual chain(Real f, Real derivative) const {
    Dual result;
    result.value = f;
    for (std::size_t i = 0; i < N; ++i) result.derivatives[i] = derivative * derivatives[i];
    return result;
  }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) derivatives[i] += b.derivatives[i];
    return *this;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual result;
    result.value = a.value + b.value;
    for (std::size_t i = 0; i < N; ++i) result.derivatives[i] = a.derivatives[i] + b.derivatives[i];
    return result;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual result;
    result.value = a.value - b.value;
    for (std::size_t i = 0; i < N; ++i) result.derivatives[i] = a.derivatives[i] - b.derivatives[i];
    return result;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual result;
    result.value = a.value * b.value;
    for (std::size_t i = 0; i < N; ++i) {
      result.derivatives[i] = a.derivatives[i] * b.value + a.value * b.derivatives[i];
    }
    return result;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real inverse = 1.0 / b.value;
    Dual result;
    result.value = a.value * inverse;
    for (std::size_t i = 0; i < N; ++i) {
      result.derivatives[i] = (a.derivatives[i] - result.value * b.derivatives[i]) * inverse;
    }
    return result;
  }
  friend Dual operator+(const Dual& a, double b) {
    Dual result = a;
    result.value += b;
    return result;
  }
  friend Dual operator+(double a, const Dual& b) { return b + a; }
  friend Dual operator-(const Dual& a, double b) { return a + (-b); }
  friend Dual operator-(double a, const Dual& b) { return b.chain(a - b.value, -1.0); }
  friend Dual operator*(const Dual& a, double b) { return a.chain(a.value * b, b); }
  friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.value, a); }
  friend Dual operator/(const Dual& a, double b) { return a * (1 / b); }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1.0); }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const Real root = sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
};

/// Returns the value of a number, dual or not.
[[nodiscard]] inline double value_of(double a) { return a; }
template <int N, class Real>
[[nodiscard]] Real value_of(const Dual<N, Real>& a) {
  return a.value;
}

/// Type of the value of a number without its derivatives.
template <class T>
using ValueOf = decltype(value_of(std::declval<const T&>()));

/// Returns a number held between -1 and 1. Outside, and at the ends, its derivatives are zero.
[[nodiscard]] inline double clamped(double a) { return a >= 1 ? 1 : a <= -1 ? -1 : a; }
/// Returns 1 for a number between -1 and 1, 0 for others: the derivative of `clamped`.
[[nodiscard]] inline double clamped_derivative(double a) { return a >= 1 || a <= -1 ? 0 : 1; }
template <int N, class Real>
[[nodiscard]] Dual<N, Real> clamped(const Dual<N, Real>& a) {
  return a.chain(clamped(a.value), clamped_derivative(a.value));
}

}  // namespace vesica
