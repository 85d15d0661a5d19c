#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "functional_lists.hpp"
#include "vesica/core/dual.hpp"

namespace vesica::model {
namespace {

/// North pole of a sphere with a uniform order parameter.
template <class T>
SurfacePoint<T> sphere_point(const T& radius, double order_parameter) {
  SurfacePoint<T> point;
  point.position = {T(0.0), T(0.0), radius};
  point.normal = {T(0.0), T(0.0), T(1.0)};
  point.mean_curvature = -2.0 / radius;
  point.shape_operator.xx = 1.0 / radius;
  point.shape_operator.yy = 1.0 / radius;
  point.order_parameter = T(order_parameter);
  return point;
}

/// No symmetry, all fields nonzero; tangential gradients and shape operator for the normal e_z.
template <class T>
SurfacePoint<T> generic_point(const T& c, const T& c_x, const T& c_y) {
  SurfacePoint<T> point;
  point.position = {T(0.3), T(-0.8), T(1.7)};
  point.normal = {T(0.0), T(0.0), T(1.0)};
  point.mean_curvature = T(-1.9);
  point.mean_curvature_gradient = {T(0.6), T(-0.2), T(0.0)};
  point.shape_operator = {T(1.2), T(0.7), T(0.0), T(0.4), T(0.0), T(0.0)};
  point.order_parameter = c;
  point.order_parameter_gradient = {c_x, c_y, T(0.0)};
  return point;
}

template <class Functional>
class EveryFunctional : public testing::Test {};
TYPED_TEST_SUITE(EveryFunctional, AllFunctionals, FunctionalName);

TYPED_TEST(EveryFunctional, HasTheRadialDerivativeIntAOnASphere) {
  const auto material = generic_material();
  for (const double radius : {0.5, 1.0, 3.0}) {
    for (const double c : {-1.0, -0.4, 0.3, 1.0}) {
      const auto r = Dual<1>::input(radius, 0);
      const auto density = density_of<TypeParam>(material, sphere_point(r, c));
      const auto integral = 4 * std::numbers::pi * r * r * density;
      const double area = 4 * std::numbers::pi * radius * radius;
      const auto variation = variation_of_term<TypeParam>(material, sphere_point(radius, c));
      EXPECT_NEAR(integral.derivatives[0], area * variation.a,
                  1e-12 * (1 + std::abs(integral.value) / radius))
          << "R = " << radius << ", c = " << c;
    }
  }
}

TYPED_TEST(EveryFunctional, HasADensityAndAVariationAtAGenericPoint) {
  const auto point = generic_point(0.3, 0.5, -0.9);
  EXPECT_GT(std::abs(density_of<TypeParam>(generic_material(), point)), 1e-3);
  const auto v = variation_of_term<TypeParam>(generic_material(), point);
  EXPECT_GT(std::abs(v.a) + norm(v.b) + std::abs(v.s) + norm(v.q), 1e-3);
}

TYPED_TEST(EveryFunctional, HasTheDerivativesOfItsDensityInTheOrderParameterAndItsGradient) {
  const auto material = generic_material();
  for (const double c : {-1.3, -0.6, 0.0, 0.3, 0.9, 1.2}) {
    const auto point =
        generic_point(Dual<3>::input(c, 0), Dual<3>::input(0.5, 1), Dual<3>::input(-0.9, 2));
    const auto derivatives = density_of<TypeParam>(material, point).derivatives;
    const auto v = variation_of_term<TypeParam>(material, generic_point(c, 0.5, -0.9));
    EXPECT_NEAR(v.s, derivatives[0], 1e-13) << "c = " << c;
    EXPECT_NEAR(v.q.x, derivatives[1], 1e-13) << "c = " << c;
    EXPECT_NEAR(v.q.y, derivatives[2], 1e-13) << "c = " << c;
    EXPECT_EQ(v.q.z, 0) << "c = " << c;
  }
}

TYPED_TEST(EveryFunctional, AgreesWithDifferencesOfItsDensity) {
  const auto material = generic_material();
  const double step = 1e-5;
  const auto density = [&](double c, double c_x, double c_y) {
    return density_of<TypeParam>(material, generic_point(c, c_x, c_y));
  };
  const auto v = variation_of_term<TypeParam>(material, generic_point(0.3, 0.5, -0.9));
  EXPECT_NEAR(v.s, (density(0.3 + step, 0.5, -0.9) - density(0.3 - step, 0.5, -0.9)) / (2 * step),
              1e-8);
  EXPECT_NEAR(v.q.x, (density(0.3, 0.5 + step, -0.9) - density(0.3, 0.5 - step, -0.9)) / (2 * step),
              1e-8);
  EXPECT_NEAR(v.q.y, (density(0.3, 0.5, -0.9 + step) - density(0.3, 0.5, -0.9 - step)) / (2 * step),
              1e-8);
}

TYPED_TEST(EveryFunctional, DependsOnTheOrderParameterUnlessItIsGeometric) {
  const std::string name(TypeParam::name);
  const bool is_geometric = name == "volume" || name == "area" || name == "mean_curvature";
  const auto v = variation_of_term<TypeParam>(generic_material(), generic_point(0.3, 0.5, -0.9));
  EXPECT_EQ(std::abs(v.s) > 1e-3, !is_geometric);
  EXPECT_EQ(norm(v.q) > 1e-3, name == "line");
}

TYPED_TEST(EveryFunctional, OfASinglePhaseDoesNotDependOnItsLabel) {
  if (TypeParam::needs_phase_field) GTEST_SKIP() << "takes part only with a phase field";
  auto material = generic_material();
  material.bending_rigidity.phase_2 = material.bending_rigidity.phase_1;
  material.spontaneous_curvature.phase_2 = material.spontaneous_curvature.phase_1;
  material.gaussian_rigidity.phase_2 = material.gaussian_rigidity.phase_1;
  material.surface_tension.phase_2 = material.surface_tension.phase_1;
  const auto a = generic_point(1.0, 0.0, 0.0);
  const auto b = generic_point(-0.2, 0.5, -0.9);
  EXPECT_EQ(density_of<TypeParam>(material, a), density_of<TypeParam>(material, b));
  EXPECT_EQ(variation_of_term<TypeParam>(material, a).a,
            variation_of_term<TypeParam>(material, b).a);
  EXPECT_EQ(variation_of_term<TypeParam>(material, b).s, 0);
}

TEST(BendingEnergyTest, OfASphereIsEightPiKForAnyRadius) {
  Material material;
  material.bending_rigidity = {2.5, 2.5};
  for (const double radius : {0.3, 1.0, 7.0}) {
    const double density = BendingEnergy::density(material, sphere_point(radius, 1.0));
    EXPECT_NEAR(4 * std::numbers::pi * radius * radius * density, 8 * std::numbers::pi * 2.5,
                1e-12);
  }
}

TEST(BendingEnergyTest, VanishesOnTheSphereThatTheSpontaneousCurvatureFits) {
  Material material;
  material.spontaneous_curvature = {-2 / 0.7, 0};
  EXPECT_NEAR(BendingEnergy::density(material, sphere_point(0.7, 1.0)), 0, 1e-28);
  EXPECT_NEAR(BendingEnergy::variation(material, sphere_point(0.7, 1.0)).a, 0, 1e-13);
  EXPECT_GT(BendingEnergy::density(material, sphere_point(0.7, -1.0)), 1);
}

TEST(GaussianEnergyTest, OfASphereIsFourPiK) {
  Material material;
  material.gaussian_rigidity = {3, 1};
  for (const double radius : {0.3, 7.0}) {
    const double area = 4 * std::numbers::pi * radius * radius;
    EXPECT_NEAR(area * GaussianEnergy::density(material, sphere_point(radius, 1.0)),
                12 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(area * GaussianEnergy::density(material, sphere_point(radius, -1.0)),
                4 * std::numbers::pi, 1e-12);
  }
}

TEST(GaussianEnergyTest, HasNoVariationForEqualRigidities) {
  Material material;
  material.gaussian_rigidity = {3, 3};
  const auto v = GaussianEnergy::variation(material, generic_point(0.3, 0.5, -0.9));
  EXPECT_EQ(std::abs(v.a) + norm(v.b) + std::abs(v.s) + norm(v.q), 0);
}

/// Midpoint rule over the profile c = tanh(s / eps) of a straight interface; it decays
/// exponentially, so the rule is exact to rounding.
TEST(LineEnergyTest, OfTheTanhProfileIsFourThirdsSigmaPerLength) {
  for (const double width : {0.05, 0.4}) {
    Material material;
    material.line_tension = 1.7;
    material.interface_width = width;
    double energy = 0;
    const double step = width / 50;
    for (int i = -1500; i < 1500; ++i) {
      const double c = std::tanh((i + 0.5) * step / width);
      SurfacePoint<double> point;
      point.order_parameter = c;
      point.order_parameter_gradient = {(1 - c * c) / width, 0, 0};
      energy += step * density_of<LineEnergy>(material, point);
    }
    EXPECT_NEAR(energy, 4.0 / 3 * 1.7, 1e-12);
  }
}

}  // namespace
}  // namespace vesica::model
