#include "vesica/relax/remesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fake_stepper.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"

namespace vesica::relax {
namespace {

Remesh request() {
  Remesh remesh;
  remesh.max_nodes = 1e6;
  remesh.reason = "the test asks";
  return remesh;
}

/// An ellipsoid with phases whose fields are smooth functions of the place.
test::RelaxationCase smooth_case() {
  test::RelaxationCase result;
  result.model.material.interface_width = 0.3;
  result.start = test::start_on(test::make_ellipsoid({1.6, 0.7, 0.7}, 6));
  auto& state = result.start;
  const auto& x = state.values.positions;
  state.values.order_parameter = (x.col(0).array() / 0.4).tanh().matrix();
  state.values.mean_curvature = -2 - x.col(0).array().square();
  state.values.multipliers = {27.0, -9.0, 1.5};
  state.rates = state.values;
  state.rates.positions = 0.1 * x;
  state.rates.multipliers = {};
  state.time = 0.25;
  state.damping = 0.75;
  return result;
}

TEST(Remesh, KeepsVolumeAreaAndPhaseDifference) {
  const auto c = smooth_case();
  const auto changed = remeshed(c.model, c.start, request());
  ASSERT_TRUE(changed.has_value());
  EXPECT_NE(changed->triangulation->num_nodes(), c.start.triangulation->num_nodes());
  const auto before = measure::measure(c.model, c.start);
  const auto after = measure::measure(c.model, *changed);
  EXPECT_NEAR(after.measures.volume(), before.measures.volume(), 1e-11);
  EXPECT_NEAR(after.measures.area(), before.measures.area(), 1e-11);
  EXPECT_NEAR(*after.measures.phase_difference(), *before.measures.phase_difference(), 1e-11);
  EXPECT_GT(after.quality, 0.45);
}

TEST(Remesh, CarriesFieldsOverAndKeepsTheRest) {
  const auto c = smooth_case();
  const auto changed = remeshed(c.model, c.start, request());
  ASSERT_TRUE(changed.has_value());
  const auto& x = changed->values.positions;
  const Eigen::VectorXd c_there = (x.col(0).array() / 0.4).tanh().matrix();
  const Eigen::VectorXd kappa_there = -2 - x.col(0).array().square();
  // Interpolation errors of quadratic elements of size 0.3.
  EXPECT_LT((changed->values.order_parameter - c_there).cwiseAbs().maxCoeff(), 2e-2);
  EXPECT_LT((changed->values.mean_curvature - kappa_there).cwiseAbs().maxCoeff(), 2e-2);
  EXPECT_LT((changed->rates.positions - 0.1 * x).cwiseAbs().maxCoeff(), 2e-3);
  EXPECT_EQ(changed->values.multipliers.of<model::Volume>(), 27.0);
  EXPECT_EQ(changed->values.multipliers.of<model::PhaseDifference>(), 1.5);
  EXPECT_EQ(changed->time, 0.25);
  EXPECT_EQ(changed->damping, 0.75);
}

TEST(Remesh, StaysNearTheLargestNumberOfNodes) {
  const auto c = smooth_case();
  auto fine = request();
  adapt::SizeFieldOptions sizes;
  sizes.curvature_angle = 0.05;
  fine.plan = sizes;
  fine.max_nodes = 1500;
  const auto changed = remeshed(c.model, c.start, fine);
  ASSERT_TRUE(changed.has_value());
  EXPECT_NEAR(changed->triangulation->num_nodes(), 1500, 375);
}

/// Smallest sizes in the interface and at the tips of the smooth case.
struct SmallestSizes {
  double interface = 0;
  double tip = 0;
};

SmallestSizes smallest_sizes(const test::RelaxationCase& c, const adapt::SizeFieldOptions& options,
                             double max_nodes) {
  const Eigen::VectorXd sizes = wanted_sizes(c.model, c.start, options, max_nodes);
  const Eigen::ArrayXd place = c.start.values.positions.col(0).array().abs();
  return {(place < 0.2).select(sizes, 1e3).minCoeff(), (place > 1.5).select(sizes, 1e3).minCoeff()};
}

TEST(WantedSizes, GrowByOneFactorToHalfAndThenAllTogetherWhereNodesAreShort) {
  const auto c = smooth_case();
  adapt::SizeFieldOptions options;
  options.max_size = 100;
  options.curvature_angle = 0.3;
  options.interface_size = 0.2;
  const SmallestSizes fine = smallest_sizes(c, options, 1e9);
  const Eigen::VectorXd sizes = wanted_sizes(c.model, c.start, options, 1e9);
  const double nodes = adapt::wanted_nodes(c.start.surface(), sizes);
  EXPECT_NEAR(fine.interface, 0.2 * 0.3, 1e-12);

  const SmallestSizes fewer = smallest_sizes(c, options, 0.6 * nodes);
  const double factor = fewer.interface / fine.interface;
  EXPECT_GT(factor, 1.2);
  EXPECT_LT(factor, 0.5 / 0.3);
  EXPECT_NEAR(fewer.tip / fine.tip, factor, 1e-9);

  const SmallestSizes few = smallest_sizes(c, options, 0.3 * nodes);
  EXPECT_NEAR(few.tip / fine.tip, 0.5 / 0.3, 1e-9);
  EXPECT_GT(few.interface / fine.interface, 0.5 / 0.3);
  EXPECT_LT(few.interface / fine.interface, 0.5 / 0.2);

  const SmallestSizes fewest = smallest_sizes(c, options, 0.02 * nodes);
  EXPECT_GT(fewest.interface, 0.5 * 0.3);
  EXPECT_NEAR(fewest.tip / fewest.interface, 0.5 / 0.3 * fine.tip / (0.5 * 0.3), 1e-9);
}

TEST(Remesh, InTheMiddleOfARampGoesOnWithIt) {
  auto c = test::table_1_case(2);
  const double volume = c.model.targets.of<model::Volume>()->last();
  c.model.targets.of<model::Volume>() = model::Schedule::ramp(volume, 0.9 * volume, 0, 0.04);
  c.model.material.line_tension = model::Schedule::ramp(1, 2, 0, 0.04);
  auto stepper = run::make_stepper({}, c.model, c.start);
  solve::StepReport report;
  while (stepper->state().time < 0.02) report = stepper->step(0.02);
  const auto before = measure::measure(c.model, stepper->state());
  ASSERT_LT(std::abs(*before.constraint_errors.of<model::Volume>()), 5e-3);
  auto changed = remeshed(c.model, stepper->state(), request());
  ASSERT_TRUE(changed.has_value());
  EXPECT_NEAR(*measure::measure(c.model, *changed).constraint_errors.of<model::Volume>(),
              *before.constraint_errors.of<model::Volume>(), 1e-10);
  stepper = run::restart_stepper({}, c.model, std::move(*changed), {0.3 * report.step_size});
  while (stepper->state().time < 0.08) {
    report = stepper->step(0.08);
    ASSERT_EQ(report.status, solve::StepStatus::accepted) << report.reason;
    const auto error =
        measure::measure(c.model, stepper->state()).constraint_errors.of<model::Volume>();
    EXPECT_LT(std::abs(*error), 5e-3) << "t = " << stepper->state().time;
  }
  EXPECT_LT(
      std::abs(*measure::measure(c.model, stepper->state()).constraint_errors.of<model::Volume>()),
      5e-4);
}

/// Asks for one new mesh after a step, when a step fails, or at the end.
class OneRemesh final : public Controller {
 public:
  explicit OneRemesh(long step) : step_(step) {}
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override {
    return view.report.counts.steps == step_ ? once() : std::vector<Request>{};
  }
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView&) override { return once(); }
  [[nodiscard]] std::vector<Request> respond_to_rest(const StepView&) override { return once(); }

 private:
  [[nodiscard]] std::vector<Request> once() {
    if (std::exchange(is_done_, true)) return {};
    return {request()};
  }

  long step_;
  bool is_done_ = false;
};

/// A run of fake steppers whose mesh changes once.
class RunWithRemeshTest : public ::testing::Test {
 protected:
  Outcome run(long remesh_step, double speed, long failing_step = -1) {
    auto first = std::make_unique<FakeStepper>([speed](long) { return speed; });
    first->failing_step = failing_step;
    std::unique_ptr<solve::Stepper> stepper = std::move(first);
    const auto restart = [&](problem::State start, const solve::Restart& how) {
      restarts_.push_back(how);
      start_ = std::move(start);
      return std::make_unique<FakeStepper>([speed](long) { return speed; });
    };
    OneRemesh controller(remesh_step);
    const std::array<Controller*, 1> controllers{&controller};
    return relax(stepper, restart, free_model(), stop_, {}, controllers);
  }

  StopOptions stop_;
  std::vector<solve::Restart> restarts_;
  problem::State start_;
};

TEST_F(RunWithRemeshTest, CountsStepsOfAllSteppers) {
  stop_.max_steps = 10;
  const Outcome outcome = run(4, 1);
  EXPECT_EQ(outcome.status, RunStatus::step_limit);
  EXPECT_EQ(outcome.report.counts.steps, 10);
  ASSERT_EQ(outcome.mesh_changes.size(), 1U);
  EXPECT_EQ(outcome.mesh_changes[0].step, 4);
  EXPECT_EQ(outcome.mesh_changes[0].nodes_before, 42);
  EXPECT_EQ(outcome.mesh_changes[0].nodes_after, start_.triangulation->num_nodes());
  EXPECT_EQ(outcome.mesh_changes[0].reason, "the test asks");
  ASSERT_EQ(outcome.events.size(), 1U);
  EXPECT_EQ(outcome.events[0].step, 4);
  EXPECT_TRUE(outcome.events[0].what.starts_with("remeshed: 42 -> ")) << outcome.events[0].what;
  EXPECT_TRUE(outcome.events[0].what.ends_with(", because the test asks"));
  ASSERT_EQ(restarts_.size(), 1U);
  EXPECT_DOUBLE_EQ(restarts_[0].initial_step, 0.3);  // of a step of 1
}

TEST_F(RunWithRemeshTest, GoesOnAfterAFailedStep) {
  stop_.max_steps = 10;
  const Outcome outcome = run(-1, 1, 6);
  EXPECT_EQ(outcome.status, RunStatus::step_limit);
  EXPECT_EQ(outcome.report.counts.steps, 10);
  ASSERT_EQ(outcome.mesh_changes.size(), 1U);
  EXPECT_EQ(outcome.mesh_changes[0].step, 5);
  EXPECT_DOUBLE_EQ(restarts_.at(0).initial_step, 0.03);
}

TEST_F(RunWithRemeshTest, RestsAnewAfterTheChangeAtTheEnd) {
  const Outcome outcome = run(-1, 1e-9);
  EXPECT_EQ(outcome.status, RunStatus::converged);
  ASSERT_EQ(outcome.mesh_changes.size(), 1U);
  // The multipliers have to be at rest in three steps on either mesh, after one to compare with.
  EXPECT_EQ(outcome.mesh_changes[0].step, 4);
  EXPECT_EQ(outcome.report.counts.steps, 8);
}

TEST(RelaxWithoutFactory, RefusesANewMesh) {
  FakeStepper stepper([](long) { return 1.0; });
  OneRemesh controller(2);
  const std::array<Controller*, 1> controllers{&controller};
  EXPECT_THROW(relax(stepper, free_model(), {}, {}, controllers), ConfigError);
}

}  // namespace
}  // namespace vesica::relax
