#include "vesica/fem/surface_element.hpp"

#include <gtest/gtest.h>

namespace vesica::fem {
namespace {

constexpr double rounding = 1e-14;

void expect_vector(const Vec3<double>& a, double x, double y, double z) {
  EXPECT_NEAR(a.x, x, rounding);
  EXPECT_NEAR(a.y, y, rounding);
  EXPECT_NEAR(a.z, z, rounding);
}

const Vec3<double> x_u{2, 0.5, 0.3};
const Vec3<double> x_v{-0.4, 1.5, 0.7};

TEST(TangentFrame, HasTheDualBasisOfTheTangentPlane) {
  const auto frame = tangent_frame(x_u, x_v);
  EXPECT_NEAR(dot(frame.dual_u, x_u), 1, rounding);
  EXPECT_NEAR(dot(frame.dual_u, x_v), 0, rounding);
  EXPECT_NEAR(dot(frame.dual_v, x_u), 0, rounding);
  EXPECT_NEAR(dot(frame.dual_v, x_v), 1, rounding);
  EXPECT_NEAR(dot(frame.dual_u, frame.normal), 0, rounding);
  EXPECT_NEAR(dot(frame.dual_v, frame.normal), 0, rounding);
}

TEST(TangentFrame, HasAUnitNormalOnTheSideOfTheCrossProduct) {
  const auto frame = tangent_frame(x_u, x_v);
  EXPECT_NEAR(norm(frame.normal), 1, rounding);
  EXPECT_NEAR(dot(frame.normal, cross(x_u, x_v)), norm(cross(x_u, x_v)), rounding);
  EXPECT_NEAR(frame.area_element, norm(cross(x_u, x_v)), rounding);
}

TEST(SurfaceGradient, IsTheTangentialPartOfTheGradientOfALinearFunction) {
  const auto frame = tangent_frame(x_u, x_v);
  const Vec3<double> g{1, -2, 3};
  const auto gradient = surface_gradient(frame, dot(g, x_u), dot(g, x_v));
  const auto expected = g - dot(g, frame.normal) * frame.normal;
  expect_vector(gradient, expected.x, expected.y, expected.z);
}

/// The graph z = (a x^2 + 2 b x y + c y^2) / 2 at the origin, in skew parameters (x, y) = (u + v/2,
/// 3 v).
Sym3<double> graph_shape_operator(double a, double b, double c) {
  const Vec3<double> du{1, 0, 0};
  const Vec3<double> dv{0.5, 3, 0};
  const auto frame = tangent_frame(du, dv);
  const auto second = [&](const Vec3<double>& p, const Vec3<double>& q) {
    return Vec3<double>{0, 0, a * p.x * q.x + b * (p.x * q.y + p.y * q.x) + c * p.y * q.y};
  };
  return element_shape_operator(frame, second(du, du), second(du, dv), second(dv, dv));
}

TEST(ElementShapeOperator, IsMinusTheHessianOfAGraphSeenFromAbove) {
  const auto q = graph_shape_operator(0.7, -0.2, 1.1);
  EXPECT_NEAR(q.xx, -0.7, rounding);
  EXPECT_NEAR(q.xy, 0.2, rounding);
  EXPECT_NEAR(q.yy, -1.1, rounding);
  EXPECT_NEAR(q.zz, 0, rounding);
  EXPECT_NEAR(q.yz, 0, rounding);
  EXPECT_NEAR(q.xz, 0, rounding);
}

TEST(ElementShapeOperator, IsPositiveOnTopOfASphere) {
  const double radius = 2;
  const auto q = graph_shape_operator(-1 / radius, 0, -1 / radius);
  EXPECT_NEAR(q.xx, 1 / radius, rounding);
  EXPECT_NEAR(q.yy, 1 / radius, rounding);
}

}  // namespace
}  // namespace vesica::fem
