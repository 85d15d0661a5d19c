#include "vesica/core/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vesica/core/small_tensor.hpp"

namespace vesica {
namespace {

constexpr double a_value = 1.7;
constexpr double b_value = -0.6;
using Pair = Dual<2>;

Pair a() { return Pair::input(a_value, 0); }
Pair b() { return Pair::input(b_value, 1); }

/// Equal up to the rounding of a few operations.
void expect_dual(const Pair& actual, double value, double da, double db) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(actual.value, value, rounding * (1 + std::abs(value)));
  EXPECT_NEAR(actual.derivatives[0], da, rounding * (1 + std::abs(da)));
  EXPECT_NEAR(actual.derivatives[1], db, rounding * (1 + std::abs(db)));
}

TEST(Dual, IsAConstantUnlessItIsAnInput) {
  expect_dual(Pair(3.0), 3, 0, 0);
  expect_dual(a(), a_value, 1, 0);
  expect_dual(b(), b_value, 0, 1);
}

TEST(Dual, AddsAndSubtracts) {
  expect_dual(a() + b(), a_value + b_value, 1, 1);
  expect_dual(a() - b(), a_value - b_value, 1, -1);
  expect_dual(-a(), -a_value, -1, 0);
  Pair sum = a();
  sum += b();
  sum += b();
  expect_dual(sum, a_value + 2 * b_value, 1, 2);
}

TEST(Dual, MultipliesByTheProductRule) {
  expect_dual(a() * b(), a_value * b_value, b_value, a_value);
  expect_dual(a() * a(), a_value * a_value, 2 * a_value, 0);
}

TEST(Dual, DividesByTheQuotientRule) {
  expect_dual(a() / b(), a_value / b_value, 1 / b_value, -a_value / (b_value * b_value));
}

TEST(Dual, MixesWithConstantsOnBothSides) {
  expect_dual(a() + 2.0, a_value + 2, 1, 0);
  expect_dual(2.0 + a(), a_value + 2, 1, 0);
  expect_dual(a() - 2.0, a_value - 2, 1, 0);
  expect_dual(2.0 - a(), 2 - a_value, -1, 0);
  expect_dual(a() * 3.0, 3 * a_value, 3, 0);
  expect_dual(3.0 * b(), 3 * b_value, 0, 3);
  expect_dual(b() / 4.0, b_value / 4, 0, 0.25);
  expect_dual(1.0 / a(), 1 / a_value, -1 / (a_value * a_value), 0);
}

TEST(Dual, TakesTheSquareRoot) {
  const double root = std::sqrt(a_value);
  expect_dual(sqrt(a()), root, 0.5 / root, 0);
}

TEST(Dual, AppliesAnyFunctionByTheChainRule) {
  expect_dual((a() * b()).chain(std::exp(a_value * b_value), std::exp(a_value * b_value)),
              std::exp(a_value * b_value), b_value * std::exp(a_value * b_value),
              a_value * std::exp(a_value * b_value));
}

TEST(Dual, GivesItsValueLikeAPlainNumber) {
  EXPECT_EQ(value_of(a()), a_value);
  EXPECT_EQ(value_of(a_value), a_value);
}

/// Area of a triangle with corners (p, q, 1), (q, p^2, p), (0, 0, 0): a formula through the tensors
/// that the kernels use.
template <class T>
T triangle_area(const T& p, const T& q) {
  const Vec3<T> u{p, q, T(1.0)};
  const Vec3<T> v{q, p * p, p};
  return 0.5 * norm(cross(u, v)) + dot(u, v) / (2.0 + p * p) - norm_squared(Sym3<T>{p, q, p, q});
}

TEST(Dual, DifferentiatesAFormulaOfTensorsLikeCentralDifferences) {
  const auto exact = triangle_area(a(), b());
  EXPECT_DOUBLE_EQ(exact.value, triangle_area(a_value, b_value));
  constexpr double h = 1e-5;  // truncation h^2 = 1e-10, rounding 1e-16 / h = 1e-11
  const double da =
      (triangle_area(a_value + h, b_value) - triangle_area(a_value - h, b_value)) / (2 * h);
  const double db =
      (triangle_area(a_value, b_value + h) - triangle_area(a_value, b_value - h)) / (2 * h);
  ASSERT_GT(std::abs(da), 0.1);
  ASSERT_GT(std::abs(db), 0.1);
  EXPECT_NEAR(exact.derivatives[0], da, 1e-8);
  EXPECT_NEAR(exact.derivatives[1], db, 1e-8);
}

}  // namespace
}  // namespace vesica
