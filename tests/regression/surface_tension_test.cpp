#include <gtest/gtest.h>

#include <cmath>

#include "roads.hpp"

namespace vesica {
namespace {

class SurfaceTensionOn : public testing::TestWithParam<test::Road> {};

/// With tau = [2, 0] the energy int tau(c) is A + int h(c), so at fixed area and phase difference
/// every discretisation sees the same shapes: lambda_A and lambda_c fall by exactly 1 and E rises
/// by tau_1 A_1 = A + int h(c).
TEST_P(SurfaceTensionOn, ShiftsTwoMultipliersAndTheEnergyAndNothingElse) {
  const test::Road& road = GetParam();
  const auto without = test::table_1_case(2);
  auto with = without;
  with.model.material.surface_tension = {2.0, 0.0};
  relax::StopOptions stop;
  stop.max_steps = road.max_steps;
  const auto a = test::run_case(without, road.options, stop);
  const auto b = test::run_case(with, road.options, stop);
  ASSERT_EQ(a.outcome.status, b.outcome.status) << a.outcome.reason << "; " << b.outcome.reason;
  ASSERT_NE(a.outcome.status, relax::RunStatus::numerical_failure) << a.outcome.reason;

  const auto& lambda = a.state.values.multipliers;
  const auto& shifted = b.state.values.multipliers;
  ASSERT_GT(std::abs(*lambda.of<model::Area>()), 0.1);
  EXPECT_NEAR(*shifted.of<model::Area>() - *lambda.of<model::Area>(), -1, 2e-5);
  EXPECT_NEAR(*shifted.of<model::PhaseDifference>() - *lambda.of<model::PhaseDifference>(), -1,
              2e-5);
  EXPECT_NEAR(*shifted.of<model::Volume>(), *lambda.of<model::Volume>(), 2e-5);
  const auto& measured = b.outcome.diagnostics;
  const double tau_1_area_1 = measured.measures.area() + *measured.measures.phase_difference();
  EXPECT_NEAR(b.energy() - a.energy(), tau_1_area_1, 1e-6);
  EXPECT_NEAR(*measured.energy.of<model::SurfaceTension>(), tau_1_area_1, 1e-9);
  EXPECT_FALSE(a.outcome.diagnostics.energy.of<model::SurfaceTension>());
  EXPECT_LT((a.state.values.positions - b.state.values.positions).cwiseAbs().maxCoeff(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(AllRoads, SurfaceTensionOn, testing::ValuesIn(test::all_roads()));

}  // namespace
}  // namespace vesica
