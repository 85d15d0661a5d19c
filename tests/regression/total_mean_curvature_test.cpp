#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "roads.hpp"
#include "vesica/measure/diagnostics.hpp"

namespace vesica {
namespace {

/// An ellipsoid of two phases without symmetry about an axis. On a capsule the gradients of volume,
/// area and total mean curvature would be linearly dependent.
test::RelaxationCase ellipsoid_case() {
  auto result = test::table_1_case(1);
  result.model.material.interface_width = 0.5;
  const auto surface = test::make_ellipsoid({1.6, 1.0, 0.8}, 4);
  phase::PhaseOptions phase;
  phase.from = -1.2;
  phase.to = 1.0;
  result.start = test::start_on(surface);
  result.start.values.order_parameter = phase::initial_phase(phase, surface, 0.5, 2.0);
  const auto measured = measure::measure(result.model, result.start).measures;
  result.model.targets = {measured.volume(), measured.area(), 2.0};
  return result;
}

class TotalMeanCurvatureOn : public testing::TestWithParam<test::Road> {
 protected:
  [[nodiscard]] static test::RelaxationResult run(const model::Schedule& target) {
    auto vesicle = ellipsoid_case();
    vesicle.model.targets.of<model::TotalMeanCurvature>() = target;
    relax::StopOptions stop;
    stop.max_steps = GetParam().max_steps;
    return test::run_case(vesicle, GetParam().options, stop);
  }
};

/// dE/d(target) = -lambda, by a central difference. All roads have -2.47 in the middle.
TEST_P(TotalMeanCurvatureOn, HoldsItsTargetAtTheCostThatTheMultiplierSays) {
  if (GetParam().options.method == solve::Method::semi_implicit)
    GTEST_SKIP() << "takes too many steps to an equilibrium";
  const double half = 0.05;
  std::array<test::RelaxationResult, 2> runs;
  double mean = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double target = -29.17 + (k == 0 ? -half : half);
    runs[k] = run(model::Schedule(target));
    ASSERT_EQ(runs[k].outcome.status, relax::RunStatus::converged) << runs[k].outcome.reason;
    const auto& measured = runs[k].outcome.diagnostics;
    EXPECT_NEAR(*measured.measures.of<model::TotalMeanCurvature>(), target, 1e-7);
    EXPECT_LT(std::abs(*measured.constraint_errors.of<model::TotalMeanCurvature>()), 1e-8);
    mean += 0.5 * *runs[k].state.values.multipliers.of<model::TotalMeanCurvature>();
  }
  EXPECT_NEAR(mean, -2.47, 0.005);
  EXPECT_NEAR((runs[1].energy() - runs[0].energy()) / (-mean * 2 * half), 1, 0.03);
}

TEST_P(TotalMeanCurvatureOn, HoldsItAlongItsWay) {
  const auto start = ellipsoid_case();
  const double held =
      *measure::measure(start.model, start.start).measures.of<model::TotalMeanCurvature>();
  EXPECT_NEAR(held, -29.2211, 1e-4);
  auto vesicle = start;
  vesicle.model.targets.of<model::TotalMeanCurvature>() = model::Schedule(held);
  relax::StopOptions stop;
  stop.max_steps = 10;
  for (const bool is_held : {true, false}) {
    const auto result = test::run_case(is_held ? vesicle : start, GetParam().options, stop);
    ASSERT_NE(result.outcome.status, relax::RunStatus::numerical_failure) << result.outcome.reason;
    const auto& measured = result.outcome.diagnostics;
    const double error = *measured.measures.of<model::TotalMeanCurvature>() - held;
    const auto lambda = result.state.values.multipliers.of<model::TotalMeanCurvature>();
    EXPECT_EQ(lambda.has_value(), is_held);
    EXPECT_EQ(measured.constraint_errors.of<model::TotalMeanCurvature>().has_value(), is_held);
    if (is_held) {
      EXPECT_LT(std::abs(error), 4.5e-3);
      EXPECT_GT(std::abs(*lambda), 0.1);
    } else {
      EXPECT_GT(std::abs(error), 5e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllRoads, TotalMeanCurvatureOn, testing::ValuesIn(test::all_roads()));

}  // namespace
}  // namespace vesica
