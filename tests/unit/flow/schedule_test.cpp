#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "relaxation_cases.hpp"
#include "vesica/measure/diagnostics.hpp"

/// Runs whose targets or material change in time.
namespace vesica::flow {
namespace {

using model::Schedule;
using model::ScheduleKind;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The cigar with 290 nodes and equal phases.
test::RelaxationCase cigar() {
  auto c = test::table_1_case(2);
  c.model.material.bending_rigidity = {1, 1};
  return c;
}

double largest_error(const test::RelaxationResult& result) {
  double largest = 0;
  for (const auto& error : result.outcome.diagnostics.constraint_errors.values)
    largest = std::max(largest, std::abs(error.value_or(0)));
  return largest;
}

void expect_same_end(const test::RelaxationResult& result, const test::RelaxationResult& direct,
                     double tolerance) {
  EXPECT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  ASSERT_EQ(direct.outcome.status, relax::RunStatus::converged) << direct.outcome.reason;
  EXPECT_LT(largest_error(result), 1e-8);
  EXPECT_NEAR(result.energy(), direct.energy(), tolerance);
}

class RunInTime : public testing::TestWithParam<solve::Scheme> {
 protected:
  void SetUp() override { options_.scheme = GetParam(); }

  [[nodiscard]] test::RelaxationResult run(const test::RelaxationCase& c) const {
    return test::run_case(c, options_);
  }

  solve::SolverOptions options_;
};

// The nodes of a coarse mesh end in other places after another history, which moves the energy.
constexpr double tolerance = 0.05;

TEST_P(RunInTime, EndsWhereARampOfTheMaterialEnds) {
  auto c = cigar();
  const double without = run(c).energy();
  c.model.material.spontaneous_curvature.phase_1 = -1;
  const auto direct = run(c);
  ASSERT_GT(std::abs(direct.energy() - without), 5);
  c.model.material.spontaneous_curvature.phase_1 = Schedule::ramp(0, -1, 0, 0.03);
  const auto ramped = run(c);
  EXPECT_GT(ramped.state.time, 0.03);
  expect_same_end(ramped, direct, tolerance);
}

TEST_P(RunInTime, EndsWhereTheLastStageEnds) {
  auto c = cigar();
  c.model.material.line_tension = 2;
  const auto direct = run(c);
  c.model.material.line_tension = Schedule::points(ScheduleKind::stages, {0, 0.05, 0.1}, {1, 3, 2});
  const auto staged = run(c);
  EXPECT_GT(staged.state.time, 0.1);
  expect_same_end(staged, direct, tolerance);
}

TEST_P(RunInTime, FollowsAStagedTargetWithTheRateOfTheConstraints) {
  auto c = cigar();
  const double volume = c.model.targets.of<model::Volume>()->last();
  c.model.targets.of<model::Volume>() = 0.94 * volume;
  const auto direct = run(c);
  c.model.targets.of<model::Volume>() = Schedule::points(ScheduleKind::stages, {0, 0.06, 0.12},
                                                         {volume, 0.97 * volume, 0.94 * volume});
  const auto stepper = run::make_stepper(options_, c.model, c.start);
  while (stepper->state().time < 0.12) {
    const auto report = stepper->step(infinity);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
    const double time = stepper->state().time;
    if (time != 0.06 && time != 0.12) continue;
    const auto error =
        measure::measure(c.model, stepper->state()).constraint_errors.of<model::Volume>();
    EXPECT_LT(std::abs(*error), 1e-3) << "at the end of a stage, t = " << time;
  }
  expect_same_end(run(c), direct, tolerance);
}

INSTANTIATE_TEST_SUITE_P(BothSchemes, RunInTime,
                         testing::Values(solve::Scheme::paper, solve::Scheme::variational),
                         [](const auto& info) {
                           return info.param == solve::Scheme::paper ? "Paper" : "Variational";
                         });

TEST(IdaStepper, StepsOntoAJumpOfTheMaterialAndBeginsAnew) {
  auto c = cigar();
  c.model.material.line_tension = Schedule::points(ScheduleKind::stages, {0, 4e-3}, {1, 10});
  const auto stepper = run::make_stepper({}, c.model, c.start);
  while (stepper->state().time < 4e-3)
    ASSERT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
  ASSERT_EQ(stepper->state().time, 4e-3);
  const auto before = measure::measure(c.model, stepper->state());
  ASSERT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
  const auto after = measure::measure(c.model, stepper->state());
  EXPECT_GT(*after.energy.of<model::LineEnergy>(), 5 * *before.energy.of<model::LineEnergy>());
  EXPECT_GT(after.velocity.normal, 2 * before.velocity.normal);
  double last = after.energy.total();
  for (int step = 0; step < 10; ++step) {
    ASSERT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
    const double energy = measure::measure(c.model, stepper->state()).energy.total();
    EXPECT_LT(energy, last * (1 + 1e-3)) << "t = " << stepper->state().time;
    last = energy;
  }
  EXPECT_LT(last, after.energy.total());
}

TEST(SemiImplicitStepper, HasTheMaterialOfTheTime) {
  auto c = cigar();
  solve::SolverOptions options;
  options.method = solve::Method::semi_implicit;
  options.time_step.value = 1e-4;
  const auto end = [&](const Schedule& tension) {
    c.model.material.line_tension = tension;
    const auto stepper = run::make_stepper(options, c.model, c.start);
    for (int step = 0; step < 2; ++step)
      EXPECT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
    return stepper->state().values.positions;
  };
  const auto constant = end(4);
  EXPECT_EQ(end(Schedule::ramp(1, 4, 0, 1e-4)), constant);
  EXPECT_EQ(end(Schedule::ramp(4, 1, 2e-4, 1)), constant);
  EXPECT_GT((end(1) - constant).norm(), 1e-4);
}

}  // namespace
}  // namespace vesica::flow
