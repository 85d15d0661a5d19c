#include <gtest/gtest.h>

#include <cmath>

#include "functional_lists.hpp"

/// Densities without curvature: their partial derivatives, and the variation made of them.
namespace vesica::model {
namespace {

static_assert(!LocalTerm<BendingEnergy> && HasVariation<BendingEnergy>);
static_assert(!LocalTerm<GaussianEnergy> && HasVariation<GaussianEnergy>);
static_assert(LocalTerm<LineEnergy> && LocalTerm<SurfaceTension> && LocalTerm<Volume>);

template <class Term>
class EveryLocalTerm : public testing::Test {};
TYPED_TEST_SUITE(EveryLocalTerm, AllFunctionals, FunctionalName);

template <class Term>
LocalDensity<double> density_at(const LocalPoint<double>& point, double factor = 1) {
  LocalDensity<double> f;
  Term::add_to(generic_material(), point, factor, f);
  return f;
}

LocalPoint<double> generic_local_point() {
  return {{0.7, -0.4, 1.1}, {0.0, 0.6, 0.8}, 0.3, {0.9, -0.4, 0.3}};
}

/// (f(a + h) - f(a - h)) / 2h for one of the numbers of a point.
template <class Term>
double difference(double LocalPoint<double>::*number) {
  constexpr double h = 1e-6;
  auto forward = generic_local_point();
  auto backward = forward;
  forward.*number += h;
  backward.*number -= h;
  return (density_at<Term>(forward).value - density_at<Term>(backward).value) / (2 * h);
}

template <class Term>
Vec3<double> difference(Vec3<double> LocalPoint<double>::*vector) {
  constexpr double h = 1e-6;
  Vec3<double> result;
  for (double Vec3<double>::*component : {&Vec3<double>::x, &Vec3<double>::y, &Vec3<double>::z}) {
    auto forward = generic_local_point();
    auto backward = forward;
    (forward.*vector).*component += h;
    (backward.*vector).*component -= h;
    result.*component =
        (density_at<Term>(forward).value - density_at<Term>(backward).value) / (2 * h);
  }
  return result;
}

template <class Term>
void expect_partial_derivatives() {
  using Point = LocalPoint<double>;
  const auto f = density_at<Term>(generic_local_point());
  ASSERT_GT(std::abs(f.value), 1e-2);
  EXPECT_NEAR(f.by_order_parameter, difference<Term>(&Point::order_parameter), 1e-8);
  EXPECT_LT(
      norm(f.by_order_parameter_gradient - difference<Term>(&Point::order_parameter_gradient)),
      1e-8);
  EXPECT_LT(norm(f.by_position - difference<Term>(&Point::position)), 1e-8);
  EXPECT_LT(norm(f.by_normal - difference<Term>(&Point::normal)), 1e-8);
  const bool depends_on_c = std::abs(f.by_order_parameter) > 1e-2;
  const bool depends_on_place = norm(f.by_position) > 1e-2 && norm(f.by_normal) > 1e-2;
  const std::string_view name = Term::name;
  EXPECT_EQ(depends_on_c, name == "line" || name == "surface_tension" || name == "phase");
  EXPECT_EQ(depends_on_place, name == "volume");
}

template <class Term>
void expect_linear_in_the_factor() {
  const auto once = density_at<Term>(generic_local_point());
  auto sum = density_at<Term>(generic_local_point(), 2.5);
  Term::add_to(generic_material(), generic_local_point(), -0.5, sum);
  EXPECT_NEAR(sum.value, 2 * once.value, 1e-14);
  EXPECT_NEAR(sum.by_order_parameter, 2 * once.by_order_parameter, 1e-14);
  EXPECT_LT(norm(sum.by_position - 2.0 * once.by_position), 1e-14);
}

TYPED_TEST(EveryLocalTerm, HasThePartialDerivativesOfItsDensityTimesAFactor) {
  if constexpr (LocalTerm<TypeParam>) {
    expect_partial_derivatives<TypeParam>();
    expect_linear_in_the_factor<TypeParam>();
  } else {
    GTEST_SKIP() << "looks at the curvature";
  }
}

/// On a sphere about the origin x . nu / 3 = R / 3, and its variation made of the partial
/// derivatives is the one after integration by parts: a = 1, b = 0.
TEST(VariationOfADensity, CountsHowItDependsOnPositionAndNormal) {
  const double radius = 1.7;
  SurfacePoint<double> point{};
  point.normal = {0.0, 0.6, 0.8};
  point.position = radius * point.normal;
  point.mean_curvature = -2 / radius;
  const auto v = variation_of(density_at<Volume>(point), point);
  EXPECT_NEAR(v.a, 1, 1e-14);
  EXPECT_LT(norm(v.b), 1e-14);
  point.position = point.position + Vec3<double>{0.5, 0, 0};
  EXPECT_NEAR(norm(variation_of(density_at<Volume>(point), point).b), 0.5 / 3, 1e-14);
}

TEST(SurfaceTensionTest, IsLeftOutWhereItIsZero) {
  Physics physics;
  EXPECT_FALSE(takes_part<SurfaceTension>(physics));
  physics.material.surface_tension = {0.0, 1.0};
  EXPECT_TRUE(takes_part<SurfaceTension>(physics));
  physics.is_two_phase = false;
  EXPECT_TRUE(takes_part<SurfaceTension>(physics));
  EXPECT_FALSE(takes_part<LineEnergy>(physics));
}

}  // namespace
}  // namespace vesica::model
