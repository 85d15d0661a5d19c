#pragma once

#include <array>
#include <cmath>

namespace vesica {

/// Forward-mode dual number: a value and its derivatives with respect to N inputs. Arithmetic
/// carries exact derivatives; the loops have fixed length, so compilers turn them into vector
/// instructions.
template <int N>
struct Dual {
  double value = 0;
  alignas(N % 8 == 0 ? 64 : 16) std::array<double, N> derivatives{};

  Dual() = default;
  // Implicit, so that constants mix with dual numbers in formulas.
  Dual(double constant) : value(constant) {}

  /// Makes the input number `index`, with derivative 1 in its own direction.
  [[nodiscard]] static Dual input(double value, int index) {
    Dual result(value);
    result.derivatives[static_cast<std::size_t>(index)] = 1;
    return result;
  }

  /// Returns f(this) by the chain rule, from f and f' at the value.
  [[nodiscard]] Dual chain(double f, double derivative) const {
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
    const double inverse = 1 / b.value;
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
  friend Dual operator-(double a, const Dual& b) { return b.chain(a - b.value, -1); }
  friend Dual operator*(const Dual& a, double b) { return a.chain(a.value * b, b); }
  friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.value, a); }
  friend Dual operator/(const Dual& a, double b) { return a * (1 / b); }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1); }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
};

/// Returns the value of a number, dual or not.
[[nodiscard]] inline double value_of(double a) { return a; }
template <int N>
[[nodiscard]] double value_of(const Dual<N>& a) {
  return a.value;
}

}  // namespace vesica
