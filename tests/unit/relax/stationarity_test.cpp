#include "vesica/relax/stationarity.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "controller_test.hpp"
#include "sample_surfaces.hpp"

namespace vesica::relax {
namespace {

/// Views with chosen velocity, multiplier and constraint errors on a surface with R_c = 2.
class StationarityTest : public ControllerTest {
 protected:
  StationarityTest() {
    diagnostics_.measures.of<model::Area>() = 16 * std::numbers::pi;
    diagnostics_.constraint_errors = {1e-9, -1e-9, std::nullopt};
    options_.end_time = 100;
    options_.max_steps = 50;
  }

  StepView view(double velocity, double multiplier) {
    diagnostics_.velocity.normal_rigid_free = velocity;
    diagnostics_.velocity.normal = 1;  // the plain one does not count
    state_.values.multipliers = {multiplier, 0.0, std::nullopt};
    return ControllerTest::view();
  }

  StopOptions options_;
};

/// The L2 norm over R_c = 2 is to be compared with k / R_c^3 = 1 / 8.
TEST_F(StationarityTest, WantsTheVelocityBelowTheThresholdInNaturalUnits) {
  const Stationarity criterion(options_, model_);
  (void)view(2 * 0.95e-3 / 8, 0);
  EXPECT_NEAR(criterion.normal_velocity(diagnostics_), 0.95e-3, 1e-15);
  EXPECT_TRUE(criterion.meets_velocity({state_, report_, diagnostics_}));
  (void)view(2 * 1.05e-3 / 8, 0);
  EXPECT_FALSE(criterion.meets_velocity({state_, report_, diagnostics_}));
}

/// Normals of neighbouring faces of an octahedron differ by acos(1/3); on the sphere through its
/// nodes they differ less.
TEST_F(StationarityTest, TellsWhereTheMeshIsTooCoarseForTheShape) {
  const mesh::Surface octahedron = test::octahedron();
  state_.triangulation = octahedron.triangulation;
  state_.values.positions = octahedron.positions;
  const auto coarse = Stationarity::unresolved(state_);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->status, RunStatus::unresolved);
  EXPECT_NE(coarse->reason.find("differ by up to 71 degrees"), std::string::npos) << coarse->reason;
  state_.values.positions.rowwise().normalize();
  EXPECT_FALSE(Stationarity::unresolved(state_));
}

TEST_F(StationarityTest, WantsTheMultipliersAtRestOverTheLastSteps) {
  Stationarity criterion(options_, model_);
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20)));  // nothing to compare with
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20.01)));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20)));
  EXPECT_TRUE(criterion.is_at_rest(view(1e-4, 20.01)));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20.1)));  // more than 1e-3 of 20
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20.1)));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20.1)));
  EXPECT_TRUE(criterion.is_at_rest(view(1e-4, 20.1)));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-2, 20.1)));
}

TEST_F(StationarityTest, TakesChangesOfVanishingMultipliersInNaturalUnits) {
  options_.rest_steps = 1;
  Stationarity criterion(options_, model_);
  const double unit = 1.0 / 8;  // k / R_c^3
  (void)criterion.is_at_rest(view(1e-4, 1e-5 * unit));
  EXPECT_TRUE(criterion.is_at_rest(view(1e-4, -1e-5 * unit)));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 2e-3 * unit)));
}

TEST_F(StationarityTest, CountsTheStepsWithoutNewtonIterations) {
  options_.rest_steps = 1;
  options_.steps_without_newton = 2;
  Stationarity criterion(options_, model_);
  const auto is_at_rest_after = [&](long newton) {
    report_.counts.newton = newton;
    return criterion.is_at_rest(view(1e-4, 20));
  };
  EXPECT_FALSE(is_at_rest_after(7));
  EXPECT_FALSE(is_at_rest_after(7));
  EXPECT_TRUE(is_at_rest_after(7));
  EXPECT_FALSE(is_at_rest_after(8));
}

TEST_F(StationarityTest, DoesNotRestWhileATargetMoves) {
  model_.targets.of<model::Volume>() = model::Schedule::ramp(1, 2, 0, 10);
  options_.rest_steps = 1;
  Stationarity criterion(options_, model_);
  state_.time = 5;
  (void)criterion.is_at_rest(view(1e-4, 20));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20)));
  state_.time = 10;
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20)));  // the last step still followed it
  state_.time = 10.1;
  EXPECT_TRUE(criterion.is_at_rest(view(1e-4, 20)));
}

TEST_F(StationarityTest, DoesNotRestBeforeTheLastStageOfTheMaterial) {
  model_.material.line_tension =
      model::Schedule::points(model::ScheduleKind::stages, {0, 1, 2}, {1, 2, 3});
  options_.rest_steps = 1;
  Stationarity criterion(options_, model_);
  state_.time = 2;
  (void)criterion.is_at_rest(view(1e-4, 20));
  EXPECT_FALSE(criterion.is_at_rest(view(1e-4, 20)));
  state_.time = 2.1;
  EXPECT_TRUE(criterion.is_at_rest(view(1e-4, 20)));
}

TEST_F(StationarityTest, WantsEveryConstraintThatThereIs) {
  const Stationarity criterion(options_, model_);
  EXPECT_TRUE(criterion.meets_constraints(diagnostics_));
  diagnostics_.constraint_errors.of<model::Area>() = -2e-8;
  EXPECT_FALSE(criterion.meets_constraints(diagnostics_));
  diagnostics_.constraint_errors = {};
  EXPECT_TRUE(criterion.meets_constraints(diagnostics_));
}

TEST_F(StationarityTest, NamesTheLimitThatIsReached) {
  const Stationarity criterion(options_, model_);
  EXPECT_FALSE(criterion.limit(view(1, 20)).has_value());
  report_.counts.steps = 50;
  EXPECT_EQ(criterion.limit(view(1, 20))->status, RunStatus::step_limit);
  state_.time = 100;
  EXPECT_EQ(criterion.limit(view(1, 20))->status, RunStatus::end_time);
}

TEST_F(StationarityTest, EndsAtTheWallClockLimit) {
  options_.max_seconds = 1e-9;
  const Stationarity criterion(options_, model_);
  EXPECT_EQ(criterion.limit(view(1, 20))->status, RunStatus::time_limit);
}

}  // namespace
}  // namespace vesica::relax
