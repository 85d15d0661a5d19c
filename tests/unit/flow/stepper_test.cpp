#include "vesica/solve/stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "relaxation_cases.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::flow {
namespace {

using test::RelaxationCase;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Takes steps up to `end_time`; the test fails when one does.
void advance(solve::Stepper& stepper, double end_time) {
  while (stepper.state().time < end_time) {
    const auto report = stepper.step(end_time);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  }
}

std::unique_ptr<solve::Stepper> stepper_for(const RelaxationCase& c,
                                            const solve::SolverOptions& options = {}) {
  return run::make_stepper(options, c.model, c.start);
}

/// Largest distance of corresponding nodes at `end_time` of the cigar with 290 nodes.
double distance_at(double end_time, const solve::SolverOptions& first,
                   const solve::SolverOptions& second) {
  const auto c = test::table_1_case(2);
  const auto a = stepper_for(c, first);
  const auto b = stepper_for(c, second);
  advance(*a, end_time);
  advance(*b, end_time);
  EXPECT_GT((a->state().values.positions - c.start.values.positions).norm(), 0.1);
  return (a->state().values.positions - b->state().values.positions).rowwise().norm().maxCoeff();
}

// Two runs of one method differ by the tolerance rtol |x| + atol of a step times a small factor.
constexpr double end_time = 5e-3;
constexpr double solver_tolerance = 5e-3;

#ifndef VESICA_WITHOUT_UMFPACK
TEST(IdaStepper, TakesTheSameTrajectoryWithEveryFactorisation) {
  for (const auto newton : {solve::NewtonMode::direct, solve::NewtonMode::krylov}) {
    solve::SolverOptions umfpack;
    umfpack.newton = newton;
    umfpack.linear_solver = solve::LinearSolver::umfpack;
    solve::SolverOptions klu = umfpack;
    klu.linear_solver = solve::LinearSolver::klu;
    EXPECT_LT(distance_at(end_time, umfpack, klu), solver_tolerance);
#ifndef VESICA_WITHOUT_MUMPS
    solve::SolverOptions mumps = umfpack;
    mumps.linear_solver = solve::LinearSolver::mumps;
    EXPECT_LT(distance_at(end_time, umfpack, mumps), solver_tolerance);
#endif
  }
}
#endif

TEST(IdaStepper, TakesTheSameTrajectoryWithEitherNewtonMode) {
  solve::SolverOptions krylov;
  solve::SolverOptions direct;
  direct.newton = solve::NewtonMode::direct;
  EXPECT_LT(distance_at(end_time, krylov, direct), solver_tolerance);
}

TEST(IdaStepper, NeedsFewerFactorisationsWithTheKrylovMode) {
  const auto c = test::table_1_case(2);
  const auto factorisations = [&](solve::NewtonMode newton) {
    solve::SolverOptions options;
    options.newton = newton;
    const auto stepper = stepper_for(c, options);
    solve::StepReport report;
    for (int i = 0; i < 20; ++i) report = stepper->step(infinity);
    EXPECT_EQ(report.counts.steps, 20);
    return report.counts.factorisations;
  };
  EXPECT_LT(factorisations(solve::NewtonMode::krylov), factorisations(solve::NewtonMode::direct));
}

/// The residual of the state over the residual of the same state without rates.
double relative_residual(const RelaxationCase& c, const problem::State& state) {
  const double time_unit = problem::scales_of(c.model, c.start).time();
  const problem::RelaxationProblem problem(c.start.triangulation, c.model, 1);
  const problem::EquationSettings settings{state.damping,
                                           solve::SolverOptions{}.constraint_rate / time_unit};
  const auto y = problem.layout().pack(state.values);
  const auto rates = problem.layout().pack(state.rates);
  const double without_rates =
      problem.residual(settings, state.time, y, Eigen::VectorXd::Zero(y.size())).norm();
  EXPECT_GT(without_rates, 1);
  return problem.residual(settings, state.time, y, rates).norm() / without_rates;
}

TEST(IdaStepper, StartsFromConsistentValues) {
  const auto c = test::table_1_case(2);
  const auto stepper = stepper_for(c);
  EXPECT_LT(relative_residual(c, stepper->state()), 1e-8);
  EXPECT_EQ(stepper->state().values.positions, c.start.values.positions);
  EXPECT_EQ(stepper->state().values.order_parameter, c.start.values.order_parameter);
}

TEST(IdaStepper, StaysConsistentWhenTheDampingIsSetBeforeTheFirstStep) {
  const auto c = test::table_1_case(2);
  const auto stepper = stepper_for(c);
  const auto before = measure::measure(c.model, stepper->state()).velocity;
  stepper->set_damping(10 * stepper->state().damping);
  const auto after = measure::measure(c.model, stepper->state()).velocity;
  EXPECT_LT(after.tangential, 0.5 * before.tangential);  // about alpha^-1
  EXPECT_LT(relative_residual(c, stepper->state()), 1e-8);
}

TEST(IdaStepper, DoesNotDependOnTheUnitsOfLengthAndEnergy) {
  const auto plain = test::table_1_case(2);
  const auto scaled = in_units(plain, 10, 20);
  const auto a = stepper_for(plain);
  const auto b = stepper_for(scaled);
  const double time_unit = 1e4 / 20;  // length^4 / energy
  for (int i = 0; i < 15; ++i) {
    const auto report_a = a->step(infinity);
    const auto report_b = b->step(infinity);
    ASSERT_EQ(report_a.status, solve::StepStatus::accepted) << report_a.reason;
    EXPECT_EQ(report_b.counts.newton, report_a.counts.newton);
    EXPECT_NEAR(report_b.time, time_unit * report_a.time, 1e-3 * time_unit * report_a.time);
  }
  const double energy = measure::measure(plain.model, a->state()).energy.total();
  const double scaled_energy = measure::measure(scaled.model, b->state()).energy.total();
  EXPECT_NEAR(scaled_energy, 20 * energy, 20 * energy * 1e-4);
}

TEST(IdaStepper, StopsExactlyAtTheEndTime) {
  const auto stepper = stepper_for(test::table_1_case(2));
  advance(*stepper, 1e-3);
  EXPECT_EQ(stepper->state().time, 1e-3);
}

TEST(IdaStepper, TakesTheConstraintsToRoundOffAtTheEnd) {
  const auto c = test::table_1_case(2);
  const auto stepper = stepper_for(c);
  advance(*stepper, 0.1);
  const auto before = measure::measure(c.model, stepper->state()).constraint_errors;
  ASSERT_GT(std::abs(*before.of<model::Volume>()), 1e-9);
  const auto report = stepper->finish();
  ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
  const auto errors = measure::measure(c.model, stepper->state()).constraint_errors;
  EXPECT_LT(std::abs(*errors.of<model::Volume>()), 1e-12);
  EXPECT_LT(std::abs(*errors.of<model::Area>()), 1e-12);
  EXPECT_LT(std::abs(*errors.of<model::PhaseDifference>()), 1e-12);
}

TEST(IdaStepper, ComesNearerToTheEquilibriumAtTheEnd) {
  const auto c = test::table_1_case(2);
  const auto stepper = stepper_for(c);
  const auto speed = [&] {
    return measure::measure(c.model, stepper->state()).velocity.normal_rigid_free;
  };
  while (stepper->state().time < 0.01 || speed() > 0.01)
    ASSERT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
  const double before = speed();
  ASSERT_EQ(stepper->finish().status, solve::StepStatus::accepted);
  EXPECT_LT(speed(), 0.5 * before);  // a step of the last size leaves it as it is
}

TEST(IdaStepper, LeavesTheStateWhenTheFinalSolveIsSwitchedOff) {
  const auto c = test::table_1_case(2);
  solve::SolverOptions options;
  options.final_constraint_solve = false;
  const auto stepper = stepper_for(c, options);
  advance(*stepper, 1e-4);
  const mesh::Positions positions = stepper->state().values.positions;
  EXPECT_EQ(stepper->finish().status, solve::StepStatus::accepted);
  EXPECT_EQ(stepper->state().values.positions, positions);
}

TEST(IdaStepper, LeavesTheStateAtTheLastGoodStepWhenAStepFails) {
  const auto stepper = stepper_for(test::table_1_case(2));
  advance(*stepper, 1e-4);
  const auto before = stepper->state();
  stepper->set_damping(std::numeric_limits<double>::quiet_NaN());
  const auto report = stepper->step(infinity);
  EXPECT_EQ(report.status, solve::StepStatus::failed);
  EXPECT_NE(report.reason.find("IDASolve at t = 0.0001: IDA_"), std::string::npos) << report.reason;
  EXPECT_NE(report.reason.find("not finite at node"), std::string::npos) << report.reason;
  EXPECT_EQ(stepper->state().time, before.time);
  EXPECT_EQ(stepper->state().values.positions, before.values.positions);
  EXPECT_EQ(stepper->state().values.order_parameter, before.values.order_parameter);
  EXPECT_EQ(stepper->state().rates.positions, before.rates.positions);
}

TEST(IdaStepper, RefusesAStartWithoutConsistentValues) {
  auto c = test::table_1_case(2);
  c.start.values.order_parameter[3] = std::numeric_limits<double>::quiet_NaN();
  try {
    (void)stepper_for(c);
    FAIL() << "nothing thrown";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("initial values"), std::string::npos) << error.what();
  }
}

TEST(IdaStepper, CarriesNoPhaseFieldForOnePhase) {
  const auto c = test::single_phase_case(test::make_ellipsoid({1.5, 1, 1}, 2), 5.8, 16);
  const auto stepper = stepper_for(c);
  for (int i = 0; i < 5; ++i)
    ASSERT_EQ(stepper->step(infinity).status, solve::StepStatus::accepted);
  const auto& values = stepper->state().values;
  EXPECT_EQ(values.order_parameter.size(), 0);
  EXPECT_TRUE(values.multipliers.of<model::Volume>().has_value());
  EXPECT_TRUE(values.multipliers.of<model::Area>().has_value());
  EXPECT_FALSE(values.multipliers.of<model::PhaseDifference>().has_value());
}

TEST(IdaStepper, FollowsARampOfTheVolumeAndStepsOntoItsKinks) {
  auto c = test::table_1_case(2);
  const double volume = c.model.targets.of<model::Volume>()->last();
  c.model.targets.of<model::Volume>() = model::Schedule::ramp(volume, 0.97 * volume, 2e-3, 6e-3);
  solve::SolverOptions options;
  options.rtol = 1e-4;
  // The error test allows displacements of rtol 2 R_c a step, that is 9e-4 of the volume, and the
  // kinks upset it for a few steps; the target moves by 0.03.
  constexpr double tolerance = 5e-3;
  const auto stepper = stepper_for(c, options);
  bool met_start = false;
  bool met_end = false;
  while (stepper->state().time < 1e-2) {
    ASSERT_EQ(stepper->step(1e-2).status, solve::StepStatus::accepted);
    const auto& state = stepper->state();
    met_start = met_start || state.time == 2e-3;
    met_end = met_end || state.time == 6e-3;
    const auto error = measure::measure(c.model, state).constraint_errors.of<model::Volume>();
    EXPECT_LT(std::abs(*error), tolerance) << "t = " << state.time;
  }
  EXPECT_TRUE(met_start);
  EXPECT_TRUE(met_end);
}

}  // namespace
}  // namespace vesica::flow
