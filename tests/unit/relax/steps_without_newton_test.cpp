#include <gtest/gtest.h>

#include "vesica/relax/stationarity.hpp"

namespace vesica::relax {
namespace {

/// A vesicle at rest after a step that took `newton` Newton iterations in all.
bool is_at_rest(Stationarity& criterion, long newton) {
  problem::State state;
  state.values.multipliers.of<model::Volume>() = 1.0;
  solve::StepReport report;
  report.counts.newton = newton;
  measure::Diagnostics diagnostics;
  diagnostics.measures.of<model::Area>() = 12.5;
  return criterion.is_at_rest({state, report, diagnostics});
}

TEST(StepsWithoutNewton, AreCountedFromTheLastIteration) {
  StopOptions options;
  options.rest_steps = 1;
  options.steps_without_newton = 2;
  const model::Model model;
  Stationarity criterion(options, model);
  EXPECT_FALSE(is_at_rest(criterion, 4));
  EXPECT_FALSE(is_at_rest(criterion, 4));
  EXPECT_TRUE(is_at_rest(criterion, 4));
  EXPECT_FALSE(is_at_rest(criterion, 5));
  EXPECT_FALSE(is_at_rest(criterion, 5));
  EXPECT_TRUE(is_at_rest(criterion, 5));
}

TEST(StepsWithoutNewton, AreNotAskedForByDefault) {
  StopOptions options;
  options.rest_steps = 1;
  const model::Model model;
  Stationarity criterion(options, model);
  EXPECT_FALSE(is_at_rest(criterion, 3));
  EXPECT_TRUE(is_at_rest(criterion, 6));
  EXPECT_TRUE(is_at_rest(criterion, 9));
}

}  // namespace
}  // namespace vesica::relax
