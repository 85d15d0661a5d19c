#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace vesica {

/// Eight numbers that go through the same formula at once, one a lane: a kernel over packs treats
/// eight elements with the vector instructions of the processor. Arithmetic acts lane by lane.
struct Pack {
  static constexpr int size = 8;
  using Lanes = double __attribute__((vector_size(64)));

  Lanes lanes{};

  Pack() = default;
  // Implicit, so that constants mix with packs in formulas.
  Pack(double a) : lanes{a, a, a, a, a, a, a, a} {}
  explicit Pack(const Lanes& a) : lanes(a) {}

  [[nodiscard]] double operator[](int lane) const { return lanes[lane]; }
  void set(int lane, double value) { lanes[lane] = value; }

  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.lanes + b.lanes); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.lanes - b.lanes); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.lanes * b.lanes); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.lanes / b.lanes); }
  friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }
  Pack& operator+=(const Pack& b) {
    lanes += b.lanes;
    return *this;
  }
};

/// Applies a function of numbers to each lane.
template <class Function, class... Packs>
[[nodiscard]] Pack lanewise(const Function& function, const Packs&... packs) {
  Pack result;
  for (int lane = 0; lane < Pack::size; ++lane) result.set(lane, function(packs[lane]...));
  return result;
}

[[nodiscard]] inline Pack value_of(const Pack& a) { return a; }

[[nodiscard]] inline Pack sqrt(const Pack& a) {
#if defined(__AVX512F__)
  return Pack(Pack::Lanes(_mm512_maskz_sqrt_pd(0xff, __m512d(a.lanes))));
#else
  return lanewise([](double x) { return std::sqrt(x); }, a);
#endif
}

[[nodiscard]] inline Pack atan2(const Pack& y, const Pack& x) {
  return lanewise([](double b, double a) { return std::atan2(b, a); }, y, x);
}

[[nodiscard]] inline Pack max(const Pack& a, const Pack& b) {
  return Pack(a.lanes > b.lanes ? a.lanes : b.lanes);
}
[[nodiscard]] inline Pack abs(const Pack& a) { return max(a, -a); }

/// Returns the numbers held between -1 and 1.
[[nodiscard]] inline Pack clamped(const Pack& a) {
  const Pack one(1.0);
  const Pack::Lanes below = a.lanes >= one.lanes ? one.lanes : a.lanes;
  return Pack(below <= -one.lanes ? -one.lanes : below);
}

/// Returns the derivative of `clamped`.
[[nodiscard]] inline Pack clamped_derivative(const Pack& a) {
  const Pack one(1.0);
  const Pack zero;
  const Pack::Lanes below = a.lanes >= one.lanes ? zero.lanes : one.lanes;
  return Pack(a.lanes <= -one.lanes ? zero.lanes : below);
}

}  // namespace vesica
