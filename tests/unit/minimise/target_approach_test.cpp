#include "minimise/target_approach.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "relaxation_cases.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::minimise {
namespace {

constexpr double pi = std::numbers::pi;

double reduced_volume(double volume, double area) {
  return volume / (4 * pi / 3 * std::pow(area / (4 * pi), 1.5));
}

void expect_met(const test::RelaxationCase& start, const Approach& approach) {
  EXPECT_TRUE(approach.is_done);
  EXPECT_LT(approach.error, 1e-6);
  EXPECT_NEAR(largest_target_error(start.model, approach.state), approach.error, 1e-12);
  EXPECT_GT(mesh::quality(*approach.state.triangulation, approach.state.values.positions), 0.2);
}

TEST(TargetApproach, TakesAnEllipsoidToAnotherSizeAndReducedVolume) {
  const auto start = test::single_phase_case(test::make_ellipsoid({1, 1, 0.4}, 3), 94.0, 135.0);
  problem::State scaled = start.start;
  EXPECT_GT(scale_to_targets(start.model, scaled), 3);
  EXPECT_LT(largest_target_error(start.model, scaled), 0.3);
  const Approach approach = approach_targets(start.model, scaled, {});
  expect_met(start, approach);
  EXPECT_LT(approach.stages, 30);
}

TEST(TargetApproach, TakesASphereToASmallerVolume) {
  const double volume = 0.8 * 4 * pi / 3;
  const auto start = test::single_phase_case(test::make_sphere(3), volume, 4 * pi);
  const Approach approach = approach_targets(start.model, start.start, {.is_symmetric = true});
  expect_met(start, approach);
  const auto repeated = approach_targets(start.model, start.start, {.is_symmetric = true});
  EXPECT_EQ(approach.state.values.positions, repeated.state.values.positions);
}

TEST(TargetApproach, MeetsThePhaseDifferenceAsWell) {
  auto start = test::table_1_case(3);
  const model::Measures measured = measure::measure(start.model, start.start).measures;
  start.model.targets.of<model::PhaseDifference>() =
      *measured.of<model::PhaseDifference>() - 0.15 * measured.area();
  start.model.targets.of<model::Volume>() = 1.08 * measured.volume();
  const Approach approach = approach_targets(start.model, start.start, {});
  expect_met(start, approach);
  EXPECT_LT(approach.state.values.order_parameter.cwiseAbs().maxCoeff(), 2);
}

TEST(TargetApproach, SaysWhereTheTargetsCannotBeMet) {
  const auto start = test::single_phase_case(test::make_ellipsoid({1, 1, 0.4}, 2), 5, 4 * pi);
  ASSERT_GT(reduced_volume(5, 4 * pi), 1);
  const Approach approach = approach_targets(start.model, start.start, {});
  EXPECT_FALSE(approach.is_done);
  EXPECT_GT(approach.error, 0.05);
}

TEST(TargetApproach, EndsWhereItIsToldTo) {
  const auto start = test::single_phase_case(test::make_ellipsoid({1, 1, 0.4}, 2), 94.0, 135.0);
  int stages = 0;
  ApproachOptions options;
  options.may_go_on = [&stages] { return ++stages < 3; };
  const Approach approach = approach_targets(start.model, start.start, options);
  EXPECT_FALSE(approach.is_done);
  EXPECT_EQ(approach.stages, 2);
}

}  // namespace
}  // namespace vesica::minimise
