#include "vesica/fem/quadratic_triangle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "vesica/fem/quadrature.hpp"

namespace vesica::fem {
namespace {

/// Reference coordinates of the nodes in the order of mesh::QuadraticTriangle.
constexpr std::array<std::array<double, 2>, 6> nodes{
    {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};

constexpr double u = 0.23;
constexpr double v = 0.41;

double sum(const std::array<double, 6>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (std::size_t node = 0; node < 6; ++node) {
    const auto shape = shape_values(nodes[node][0], nodes[node][1]);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(shape.value[i], i == node ? 1 : 0);
  }
}

TEST(ShapeFunctions, SumToOneEverywhere) {
  const auto shape = shape_values(u, v);
  EXPECT_NEAR(sum(shape.value), 1, 1e-15);
  EXPECT_NEAR(sum(shape.du), 0, 1e-15);
  EXPECT_NEAR(sum(shape.dv), 0, 1e-15);
}

TEST(ShapeFunctions, HaveTheirCentralDifferencesAsDerivatives) {
  constexpr double h = 1e-4;  // exact for quadratics but for rounding, 1e-16 / h
  const auto shape = shape_values(u, v);
  const auto right = shape_values(u + h, v);
  const auto left = shape_values(u - h, v);
  const auto up = shape_values(u, v + h);
  const auto down = shape_values(u, v - h);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(shape.du[i], (right.value[i] - left.value[i]) / (2 * h), 1e-11);
    EXPECT_NEAR(shape.dv[i], (up.value[i] - down.value[i]) / (2 * h), 1e-11);
  }
}

TEST(ShapeFunctions, HaveTheDifferencesOfTheirDerivativesAsSecondDerivatives) {
  constexpr double h = 1e-2;  // the derivatives are linear
  const auto second = shape_second_derivatives();
  const auto here = shape_values(u, v);
  const auto right = shape_values(u + h, v);
  const auto up = shape_values(u, v + h);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(second.duu[i], (right.du[i] - here.du[i]) / h, 1e-12);
    EXPECT_NEAR(second.duv[i], (right.dv[i] - here.dv[i]) / h, 1e-12);
    EXPECT_NEAR(second.duv[i], (up.du[i] - here.du[i]) / h, 1e-12);
    EXPECT_NEAR(second.dvv[i], (up.dv[i] - here.dv[i]) / h, 1e-12);
  }
}

/// int u^a v^b over the reference triangle.
double monomial_integral(int a, int b) {
  return std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3);
}

double quadrature_error(int a, int b) {
  double integral = 0;
  for (const auto& point : triangle_rule())
    integral += point.weight * std::pow(point.u, a) * std::pow(point.v, b);
  return std::abs(integral - monomial_integral(a, b));
}

TEST(Quadrature, IntegratesAllPolynomialsOfDegreeFive) {
  for (int degree = 0; degree <= 5; ++degree) {
    for (int a = 0; a <= degree; ++a) {
      EXPECT_LT(quadrature_error(a, degree - a), 1e-16) << "u^" << a << " v^" << degree - a;
    }
  }
}

TEST(Quadrature, DoesNotIntegrateDegreeSix) {
  EXPECT_GT(quadrature_error(6, 0), 1e-6);
  EXPECT_GT(quadrature_error(3, 3), 1e-7);
}

TEST(Quadrature, HasPositiveWeightsAndPointsInsideTheTriangle) {
  for (const auto& point : triangle_rule()) {
    EXPECT_GT(point.weight, 0);
    EXPECT_GT(point.u, 0);
    EXPECT_GT(point.v, 0);
    EXPECT_LT(point.u + point.v, 1);
  }
}

TEST(Quadrature, CarriesTheShapeFunctionsOfItsPoints) {
  for (const auto& point : triangle_rule()) {
    const auto shape = shape_values(point.u, point.v);
    EXPECT_EQ(point.shape.value, shape.value);
    EXPECT_EQ(point.shape.du, shape.du);
    EXPECT_EQ(point.shape.dv, shape.dv);
  }
}

}  // namespace
}  // namespace vesica::fem
