#include "vesica/measure/diagnostics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ellipsoid_integrals.hpp"
#include "relaxation_cases.hpp"

namespace vesica::measure {
namespace {

constexpr double pi = std::numbers::pi;

/// One phase on a sphere of radius 2, kappa = -1 at the nodes.
class DiagnosticsOfASphere : public ::testing::Test {
 protected:
  void SetUp() override {
    case_ = test::single_phase_case(test::make_sphere(6, 2.0), 32 * pi / 3, 15 * pi);
    case_.model.material.bending_rigidity = {3, 1};
    case_.model.material.gaussian_rigidity = {0.5, 0};
    auto& state = case_.start;
    state.values.mean_curvature.setConstant(-1);
    state.rates = state.values;
    state.rates.positions.setZero();
  }

  [[nodiscard]] Diagnostics measured() const { return measure(case_.model, case_.start); }

  test::RelaxationCase case_;
};

TEST_F(DiagnosticsOfASphere, HaveTheEnergiesOfPhaseOne) {
  const auto energy = measured().energy;
  EXPECT_NEAR(*energy.of<model::BendingEnergy>(), 3 * 8 * pi,
              3 * 8 * pi * 5e-5);  // area error of 1442 nodes
  EXPECT_DOUBLE_EQ(*energy.of<model::GaussianEnergy>(), 0.5 * 4 * pi);
  EXPECT_FALSE(energy.of<model::LineEnergy>().has_value());
  EXPECT_DOUBLE_EQ(energy.total(),
                   *energy.of<model::BendingEnergy>() + *energy.of<model::GaussianEnergy>());
}

/// With a shape operator that is recovered at the nodes, the error of this energy was 16 times that
/// of the whole energy (Section 4.3 of the paper, Delta_g = 4).
TEST(Diagnostics, HaveTheGaussianEnergyOfTwoPhasesToThirdOrder) {
  model::Model model;
  model.material.gaussian_rigidity = {1.5, -0.5};
  const double exact = test::exact_gaussian_energy(1, 1.6, model.material.gaussian_rigidity.at(0));
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const auto surface = test::make_ellipsoid({1, 1, 1.6}, level == 0 ? 6 : 12);
    auto state = test::start_on(surface);
    state.values.order_parameter = 0.5 + (0.5 / 1.6) * surface.positions.col(2).array();
    errors[level] = std::abs(*measure(model, state).energy.of<model::GaussianEnergy>() - exact);
  }
  EXPECT_LT(errors[1], 1e-4 * std::abs(exact));
  EXPECT_GT(errors[0], 1e-7);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3);
}

TEST_F(DiagnosticsOfASphere, HaveTheMaterialOfTheTime) {
  const double before = *measured().energy.of<model::BendingEnergy>();
  auto& k = case_.model.material.bending_rigidity.phase_1;
  k = model::Schedule::ramp(3, 12, 0, 2);
  EXPECT_EQ(*measured().energy.of<model::BendingEnergy>(), before);
  case_.start.time = 2.0 / 3;
  EXPECT_NEAR(*measured().energy.of<model::BendingEnergy>(), 2 * before, 1e-12 * before);
  EXPECT_DOUBLE_EQ(nodal_fields(case_.model, case_.start).bending_energy_density[0], 3);
  case_.start.time = 5;
  EXPECT_NEAR(*measured().energy.of<model::BendingEnergy>(), 4 * before, 1e-12 * before);
}

TEST_F(DiagnosticsOfASphere, GiveConstraintErrorsRelativeToTheirTargets) {
  const auto diagnostics = measured();
  EXPECT_NEAR(*diagnostics.constraint_errors.of<model::Volume>(), 0, 5e-5);
  EXPECT_NEAR(*diagnostics.constraint_errors.of<model::Area>(), 1.0 / 15, 5e-5);
  EXPECT_FALSE(diagnostics.constraint_errors.of<model::PhaseDifference>().has_value());
}

TEST_F(DiagnosticsOfASphere, SeeThatATranslationIsARigidMotion) {
  case_.start.rates.positions.rowwise() = Eigen::RowVector3d(0, 0, 3);
  const auto velocity = measured().velocity;
  const double normal = 3 * std::sqrt(16 * pi / 3);  // int nu_z^2 = A / 3
  EXPECT_NEAR(velocity.normal, normal, 1e-4 * normal);
  EXPECT_LT(velocity.normal_rigid_free, 1e-3 * normal);
  EXPECT_NEAR(velocity.tangential, std::sqrt(2.0) * normal, 1e-4 * normal);
}

TEST_F(DiagnosticsOfASphere, DoNotTakeARigidMotionFromAnInflation) {
  case_.start.rates.positions = case_.start.values.positions;
  const auto velocity = measured().velocity;
  EXPECT_NEAR(velocity.normal_rigid_free, 2 * std::sqrt(16 * pi), 1e-3);
  EXPECT_LT(velocity.tangential, 1e-1);
}

TEST(Diagnostics, IntegrateTheLineEnergyAndThePhaseDifference) {
  auto c = test::table_1_case(2);
  c.start.values.order_parameter.setZero();
  const auto diagnostics = measure(c.model, c.start);
  // psi(0) / eps = 1 / 0.6 on the whole surface, h(0) = 0
  EXPECT_NEAR(*diagnostics.energy.of<model::LineEnergy>(), diagnostics.measures.area() / 0.6,
              1e-12 * diagnostics.measures.area());
  EXPECT_NEAR(*diagnostics.measures.phase_difference(), 0, 1e-13);
  EXPECT_NEAR(*diagnostics.constraint_errors.of<model::PhaseDifference>(),
              -4.71 / diagnostics.measures.area(), 1e-13);
}

}  // namespace
}  // namespace vesica::measure
