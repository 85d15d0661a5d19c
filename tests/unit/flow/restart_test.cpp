#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "relaxation_cases.hpp"
#include "vesica/core/error.hpp"
#include "vesica/problem/normal_graph.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica::flow {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The cigar with 290 nodes after some steps.
problem::State moving_state(const test::RelaxationCase& c) {
  const auto stepper = run::make_stepper({}, c.model, c.start);
  for (int step = 0; step < 10; ++step) {
    const auto report = stepper->step(infinity);
    EXPECT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  }
  return stepper->state();
}

TEST(Restart, TakesAllValuesAndRatesAsTheyAre) {
  const auto c = test::table_1_case(2);
  auto state = moving_state(c);
  state.damping = 0.25;
  state.values.mean_curvature.array() += 0.5;  // not consistent with the positions
  const auto stepper = run::restart_stepper({}, c.model, state, {1e-5});
  const auto& start = stepper->state();
  EXPECT_EQ(start.time, state.time);
  EXPECT_EQ(start.damping, 0.25);
  EXPECT_EQ(start.values.positions, state.values.positions);
  EXPECT_EQ(start.values.mean_curvature, state.values.mean_curvature);
  EXPECT_EQ(start.values.order_parameter, state.values.order_parameter);
  EXPECT_EQ(start.values.multipliers.of<model::Volume>(),
            state.values.multipliers.of<model::Volume>());
  EXPECT_EQ(start.rates.positions, state.rates.positions);
}

TEST(Restart, BeginsWithTheGivenStep) {
  const auto c = test::table_1_case(2);
  const auto state = moving_state(c);
  const double size = 1e-2 * state.time;
  const auto stepper = run::restart_stepper({}, c.model, state, {size});
  stepper->set_damping(2 * state.damping);  // does not look for consistent values either
  EXPECT_EQ(stepper->state().rates.positions, state.rates.positions);
  const auto report = stepper->step(infinity);
  ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  EXPECT_DOUBLE_EQ(report.step_size, size);
  EXPECT_EQ(report.counts.steps, 1);
}

TEST(Restart, OfTheVariationalFlowTakesTheSurfaceAndItsNormalVelocity) {
  const auto c = test::table_1_case(2);
  const auto state = moving_state(c);
  for (const auto kind : {solve::LinearSolver::automatic, solve::LinearSolver::klu}) {
    solve::SolverOptions variational;
    variational.scheme = solve::Scheme::variational;
    variational.linear_solver = kind;
    const double size = 1e-2 * state.time;
    const auto stepper = run::restart_stepper(variational, c.model, state, {size});
    EXPECT_LT((stepper->state().values.positions - state.values.positions).norm(), 1e-14);
    EXPECT_EQ(stepper->state().values.order_parameter, state.values.order_parameter);
    EXPECT_EQ(stepper->state().rates.order_parameter, state.rates.order_parameter);
    const auto normals = problem::nodal_normals(*state.triangulation, state.values.positions);
    const Eigen::VectorXd speed = state.rates.positions.cwiseProduct(normals).rowwise().sum();
    ASSERT_GT(speed.norm(), 0.1);
    EXPECT_LT((stepper->state().rates.positions - speed.asDiagonal() * normals).norm(),
              1e-12 * speed.norm());
    const auto report = stepper->step(infinity);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
    EXPECT_DOUBLE_EQ(report.step_size, size);
  }
}

TEST(Restart, BeginsTheFixedStepSchemeAnewAtTheState) {
  const auto c = test::table_1_case(2);
  solve::SolverOptions fixed;
  fixed.method = solve::Method::semi_implicit;
  fixed.time_step.value = 1e-4;
  const auto stepper = run::restart_stepper(fixed, c.model, c.start, {});
  EXPECT_EQ(stepper->state().values.positions, c.start.values.positions);
  const auto report = stepper->step(infinity);
  EXPECT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  EXPECT_DOUBLE_EQ(report.step_size, 1e-4);
}

TEST(Restart, IsNotForTheAutomaticMethod) {
  const auto c = test::table_1_case(2);
  solve::SolverOptions automatic;
  automatic.method = solve::Method::automatic;
  EXPECT_THROW((void)run::restart_stepper(automatic, c.model, c.start, {}), ConfigError);
  EXPECT_THROW((void)run::make_stepper(automatic, c.model, c.start), ConfigError);
}

}  // namespace
}  // namespace vesica::flow
