#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "relaxation_cases.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::minimise {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

solve::SolverOptions minimize() {
  solve::SolverOptions options;
  options.method = solve::Method::minimize;
  return options;
}

/// A prolate ellipsoid with 362 nodes at area 4 pi.
test::RelaxationCase prolate_case(double volume) {
  return test::single_phase_case(test::make_ellipsoid({1.84, 0.66, 0.66}, 3), volume, 4 * pi);
}

TEST(CeresStepper, MultipliersAreTheDerivativesOfTheEnergy) {
  const double volume = 3.35;
  const double change = 0.01;
  const auto middle = test::run_case(prolate_case(volume), minimize());
  const auto more = test::run_case(prolate_case(volume + change), minimize());
  const auto less = test::run_case(prolate_case(volume - change), minimize());
  for (const auto* result : {&middle, &more, &less})
    ASSERT_EQ(result->outcome.status, relax::RunStatus::converged) << result->outcome.reason;
  // dF/dV = -lambda_V; the nodes of the runs differ a little
  EXPECT_NEAR((more.energy() - less.energy()) / (2 * change), -middle.volume_multiplier(),
              1e-2 * middle.volume_multiplier());
  EXPECT_GT(middle.volume_multiplier(), 10);
}

TEST(CeresStepper, ScalingOfTheShapeTiesTheMultipliersTogether) {
  const auto result = test::run_case(prolate_case(3.35), minimize());
  // The bending energy does not depend on the size: 3 lambda_V V + 2 lambda_A A = 0.
  const auto& multipliers = result.state.values.multipliers;
  const double volume_part = 3 * *multipliers.of<model::Volume>() * 3.35;
  EXPECT_NEAR(volume_part + 2 * *multipliers.of<model::Area>() * 4 * pi, 0, 1e-3 * volume_part);
}

TEST(CeresStepper, StateReportAndEnergyBelongTogether) {
  const auto c = test::table_1_case(2);
  const auto stepper = run::make_stepper(minimize(), c.model, c.start);
  const double start_energy = stepper->energy()->total();
  for (int step = 1; step <= 3; ++step) {
    const auto report = stepper->step(infinity);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
    EXPECT_EQ(report.counts.steps, step);
    EXPECT_EQ(stepper->state().time, step);
    ASSERT_TRUE(report.gradient);
    EXPECT_GT(*report.gradient, 0);
  }
  const auto& state = stepper->state();
  EXPECT_LT(stepper->energy()->total(), start_energy - 1);
  // kappa of the state, taken at the nodes, gives the energy back up to interpolation
  const auto measured = measure::measure(c.model, state);
  EXPECT_NEAR(measured.energy.total(), stepper->energy()->total(), 0.02 * start_energy);
  EXPECT_EQ(state.rates.positions.rows(), state.values.positions.rows());
  EXPECT_TRUE(std::isfinite(measured.velocity.normal));
  EXPECT_EQ(state.damping, 0);
}

TEST(CeresStepper, CurvatureOfASphereIsMinusTwoOverItsRadius) {
  const auto c = test::single_phase_case(test::make_sphere(4, 2.0), 32 * pi / 3, 16 * pi);
  const auto stepper = run::make_stepper(minimize(), c.model, c.start);
  EXPECT_NEAR(measure::measure(c.model, stepper->state()).energy.total(), 8 * pi, 1e-2);
  const auto& curvature = stepper->state().values.mean_curvature;
  EXPECT_LT((curvature.array() + 1).abs().maxCoeff(), 0.1);  // at the twelve irregular vertices
}

TEST(CeresStepper, TakesTheSameStepsInOtherUnits) {
  const auto c = test::table_1_case(2);
  const double length = 1e-3;
  const double energy = 1e5;
  const auto scaled = test::in_units(c, length, energy);
  const auto here = test::run_case(c, minimize());
  const auto there = test::run_case(scaled, minimize());
  EXPECT_EQ(here.counts().steps, there.counts().steps);
  EXPECT_NEAR(static_cast<double>(here.counts().residuals),
              static_cast<double>(there.counts().residuals), 2);
  EXPECT_NEAR(there.energy(), energy * here.energy(), 1e-7 * there.energy());
}

TEST(CeresStepper, LeavesAConstraintFreeThatHasNoTarget) {
  auto c = prolate_case(3.35);
  c.model.targets.of<model::Volume>().reset();
  const auto result = test::run_case(c, minimize());
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_FALSE(result.state.values.multipliers.of<model::Volume>());
  EXPECT_NEAR(result.energy(), 8 * pi, 1e-2);  // a sphere
  EXPECT_NEAR(*result.state.values.multipliers.of<model::Area>(), 0, 1e-2);
}

TEST(CeresStepper, FinishTakesTheConstraintsToRoundOff) {
  const auto c = test::table_1_case(2);
  const auto stepper = run::make_stepper(minimize(), c.model, c.start);
  for (int step = 0; step < 2; ++step) (void)stepper->step(infinity);
  const auto before = measure::measure(c.model, stepper->state());
  ASSERT_GT(std::abs(*before.constraint_errors.of<model::Volume>()), 1e-9);
  ASSERT_EQ(stepper->finish().status, solve::StepStatus::accepted);
  const auto after = measure::measure(c.model, stepper->state());
  for (const auto& error :
       {after.constraint_errors.of<model::Volume>(), after.constraint_errors.of<model::Area>(),
        after.constraint_errors.of<model::PhaseDifference>()})
    EXPECT_LT(std::abs(*error), 1e-12);
}

TEST(CeresStepper, FinishPolishesWhenAskedTo) {
  const auto c = test::table_1_case(2);
  auto options = minimize();
  options.polish = true;
  const auto stepper = run::make_stepper(options, c.model, c.start);
  for (int step = 0; step < 4; ++step) (void)stepper->step(infinity);
  const auto report = stepper->finish();
  ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  ASSERT_TRUE(report.polish);
  EXPECT_TRUE(report.polish->is_converged);
  EXPECT_LE(report.polish->iterations, 4);
  EXPECT_LT(*report.gradient, 1e-7);
}

TEST(CeresStepper, NewtonsMethodTakesItToRoundOffInFewSteps) {
  const auto c = test::table_1_case(2);
  const auto stepper = run::make_stepper(minimize(), c.model, c.start);
  double distance = 1;
  for (int step = 0; step < 20 && distance > 1e-2; ++step)
    distance = *stepper->step(infinity).gradient;
  for (int step = 0; step < 3; ++step) {
    const auto report = stepper->step(infinity);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
    EXPECT_LT(*report.gradient, 0.05 * distance);
    distance = *report.gradient;
  }
  const auto measured = measure::measure(c.model, stepper->state());
  EXPECT_LT(std::abs(*measured.constraint_errors.of<model::Volume>()), 1e-9);
}

/// At v = 0.8 the oblate spheroid is a saddle, and the prolate the minimum.
test::RelaxationCase oblate_case() {
  return test::single_phase_case(test::make_ellipsoid({1.25, 1.25, 0.55}, 3), 0.8 * 4 * pi / 3,
                                 4 * pi);
}

TEST(CeresStepper, LeavesASaddleAndSaysSo) {
  const auto result = test::run_case(oblate_case(), minimize());
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_NEAR(result.energy(), 34.870, 0.02);
  EXPECT_NE(result.outcome.reason.find("a minimum"), std::string::npos) << result.outcome.reason;
  ASSERT_GE(result.outcome.events.size(), 1U);
  EXPECT_TRUE(result.outcome.events.front().what.starts_with("left a saddle of energy 36."))
      << result.outcome.events.front().what;
}

TEST(CeresStepper, EndsAtASaddleWhenAskedToAndSaysSo) {
  auto options = minimize();
  options.leave_saddles = false;
  const auto result = test::run_case(oblate_case(), options);
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_GT(result.energy(), 35);
  EXPECT_NE(result.outcome.reason.find("a saddle"), std::string::npos) << result.outcome.reason;
  EXPECT_TRUE(result.outcome.events.empty());
}

TEST(CeresStepper, DampingChangesNothing) {
  const auto c = test::table_1_case(2);
  const auto one = run::make_stepper(minimize(), c.model, c.start);
  const auto other = run::make_stepper(minimize(), c.model, c.start);
  other->set_damping(17);
  (void)one->step(infinity);
  (void)other->step(infinity);
  EXPECT_EQ(one->state().values.positions, other->state().values.positions);
}

/// More volume than a sphere of this area holds.
TEST(CeresStepper, SaysThatConstraintsCannotBeMetAndKeepsAGoodState) {
  const auto c = prolate_case(1.1 * 4 * pi / 3);
  const auto result = test::run_case(c, minimize());
  EXPECT_EQ(result.outcome.status, relax::RunStatus::numerical_failure);
  EXPECT_NE(result.outcome.reason.find("cannot be met together"), std::string::npos)
      << result.outcome.reason;
  EXPECT_GT(result.outcome.diagnostics.quality, 0.1);
  EXPECT_TRUE(result.state.values.positions.allFinite());
}

TEST(CeresStepper, ARestartedOneCountsOnAndLeavesTheNodesToItsCaller) {
  // crowded nodes, which a stepper that looks after its mesh would move along the surface
  auto c = prolate_case(3.35);
  auto& x = c.start.values.positions;
  for (auto row : x.rowwise()) row[0] += 0.3 * (1.84 * 1.84 - row[0] * row[0]);
  c.start.time = 7;
  const auto spread_after_a_step = [](solve::Stepper& stepper) {
    EXPECT_EQ(stepper.step(infinity).status, solve::StepStatus::accepted);
    return mesh::area_ratio(*stepper.state().triangulation, stepper.state().values.positions);
  };
  const auto first = run::make_stepper(minimize(), c.model, c.start);
  const auto restarted = run::restart_stepper(minimize(), c.model, c.start, {});
  EXPECT_GT(spread_after_a_step(*restarted), 1.5 * spread_after_a_step(*first));
  EXPECT_EQ(restarted->state().time, 8);
}

TEST(CeresStepper, RefusesARampedTarget) {
  auto c = prolate_case(3.35);
  c.model.targets.of<model::Volume>() = model::Schedule::ramp(3.5, 3.35, 0, 1);
  EXPECT_THROW((void)run::make_stepper(minimize(), c.model, c.start), ConfigError);
}

}  // namespace
}  // namespace vesica::minimise
