#include "vesica/relax/relax.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fake_stepper.hpp"

namespace vesica::relax {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Writes what it is told into a list shared by all.
class Scribe final : public Observer {
 public:
  Scribe(std::string name, std::vector<std::string>& lines)
      : name_(std::move(name)), lines_(lines) {}
  void observe(const StepView& view) override {
    lines_.push_back(name_ + std::to_string(view.report.counts.steps));
  }
  void finish(const StepView& view, const Outcome& outcome) override {
    lines_.push_back(name_ + " end " + std::to_string(view.report.counts.steps));
    reason = outcome.reason;
  }
  std::string reason;

 private:
  std::string name_;
  std::vector<std::string>& lines_;
};

/// Asks for what a test gives it.
class Asker final : public Controller {
 public:
  using Answer = std::function<std::vector<Request>(const StepView&)>;
  explicit Asker(Answer answer) : answer_(std::move(answer)) {}
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override {
    return answer_(view);
  }

 private:
  Answer answer_;
};

class RelaxTest : public ::testing::Test {
 protected:
  Outcome run(FakeStepper& stepper, std::vector<Controller*> controllers = {}) {
    const std::array<Observer*, 2> observers{&first_, &second_};
    return relax(stepper, model_, stop_, observers, controllers);
  }

  model::Model model_ = free_model();
  StopOptions stop_;
  std::vector<std::string> lines_;
  Scribe first_{"a", lines_};
  Scribe second_{"b", lines_};
};

double steady(long) { return 1; }

TEST_F(RelaxTest, ShowsEveryStepToAllObserversInOrderBeginningWithStepZero) {
  stop_.max_steps = 2;
  FakeStepper stepper(steady);
  const auto outcome = run(stepper);
  const std::vector<std::string> expected{"a0", "b0", "a1", "b1", "a2", "b2", "a end 2", "b end 2"};
  EXPECT_EQ(lines_, expected);
  EXPECT_EQ(outcome.status, RunStatus::step_limit);
  EXPECT_EQ(first_.reason, outcome.reason);
}

TEST_F(RelaxTest, EndsAtTheEndTime) {
  stop_.end_time = 2.5;
  FakeStepper stepper(steady);
  EXPECT_EQ(run(stepper).status, RunStatus::end_time);
  EXPECT_EQ(stepper.state().time, 2.5);
}

TEST_F(RelaxTest, ConvergesWhenTheSurfaceRestsAndFinishesTheConstraints) {
  FakeStepper stepper([](long step) { return step < 5 ? 1.0 : 1e-5; });
  const auto outcome = run(stepper);
  EXPECT_EQ(outcome.status, RunStatus::converged);
  EXPECT_EQ(outcome.report.counts.steps, 5);
  EXPECT_EQ(stepper.finished, 1);
}

TEST_F(RelaxTest, ConvergesWithoutTheFinalSolveWhenTheConstraintsAreMetAnyway) {
  FakeStepper stepper([](long) { return 1e-5; });
  stepper.finish_fails = true;
  stop_.max_steps = 20;
  EXPECT_EQ(run(stepper).status, RunStatus::converged);
  EXPECT_EQ(stepper.finished, 1);
}

TEST_F(RelaxTest, DoesNotConvergeWhileAConstraintIsViolated) {
  model_.targets.of<model::Area>() = model::Schedule(13);  // the fake stays at 4 pi
  stop_.max_steps = 8;
  FakeStepper stepper([](long) { return 1e-5; });
  EXPECT_EQ(run(stepper).status, RunStatus::step_limit);
  EXPECT_GT(stepper.finished, 0);
}

TEST_F(RelaxTest, CarriesOutTheRequestsOfEveryControllerInOrder) {
  stop_.max_steps = 1;
  Asker low([](const StepView&) { return std::vector<Request>{SetDamping{0.5}}; });
  Asker high([](const StepView& view) {
    return view.report.counts.steps == 1 ? std::vector<Request>{SetDamping{3}, SetDamping{4}}
                                         : std::vector<Request>{};
  });
  FakeStepper stepper(steady);
  (void)run(stepper, {&low, &high});
  EXPECT_EQ(stepper.dampings, (std::vector<double>{0.5, 0.5, 3, 4}));
}

TEST_F(RelaxTest, StopsWhenAUsersControllerAsksForIt) {
  Asker stopper([](const StepView& view) {
    return view.report.counts.steps == 3
               ? std::vector<Request>{Stop{RunStatus::stopped, "seen enough"}}
               : std::vector<Request>{};
  });
  FakeStepper stepper(steady);
  const auto outcome = run(stepper, {&stopper});
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_EQ(outcome.reason, "seen enough");
  EXPECT_EQ(outcome.report.counts.steps, 3);
}

/// Tells what is behind a failure, a limit, or a rest.
class Explainer final : public Controller {
 public:
  [[nodiscard]] std::vector<Request> respond(const StepView&) override { return {}; }
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView&) override { return stop(); }
  [[nodiscard]] std::vector<Request> respond_to_limit(const StepView&) override { return stop(); }
  [[nodiscard]] std::vector<Request> respond_to_rest(const StepView&) override { return stop(); }

 private:
  static std::vector<Request> stop() { return {Stop{RunStatus::neck_closes, "a neck closes"}}; }
};

TEST_F(RelaxTest, EndsForTheCauseThatAControllerFindsBehindAFailedStep) {
  Explainer explainer;
  FakeStepper stepper(steady);
  stepper.failing_step = 3;
  const auto outcome = run(stepper, {&explainer});
  EXPECT_EQ(outcome.status, RunStatus::neck_closes);
  EXPECT_EQ(outcome.reason, "a neck closes; then the fake fails");
}

TEST_F(RelaxTest, EndsForTheCauseThatAControllerFindsBehindALimit) {
  Explainer explainer;
  FakeStepper stepper(steady);
  stop_.max_steps = 2;
  const auto outcome = run(stepper, {&explainer});
  EXPECT_EQ(outcome.status, RunStatus::neck_closes);
  EXPECT_EQ(outcome.reason, "a neck closes; then stop.max_steps = 2 reached");
}

TEST_F(RelaxTest, DoesNotConvergeWhenAControllerObjects) {
  Explainer explainer;
  FakeStepper stepper([](long) { return 1e-5; });
  const auto outcome = run(stepper, {&explainer});
  EXPECT_EQ(outcome.status, RunStatus::neck_closes);
  EXPECT_EQ(outcome.reason, "a neck closes");
  EXPECT_EQ(stepper.finished, 0);
}

TEST_F(RelaxTest, EndsAsANumericalFailureWhenAStepFailsAndFinishesTheObservers) {
  FakeStepper stepper(steady);
  stepper.failing_step = 3;
  const auto outcome = run(stepper);
  EXPECT_EQ(outcome.status, RunStatus::numerical_failure);
  EXPECT_EQ(outcome.reason, "the fake fails");
  EXPECT_EQ(lines_.back(), "b end 2");
}

TEST_F(RelaxTest, EndsAsANumericalFailureWhenAMeasuredValueIsNotANumber) {
  FakeStepper stepper([](long step) { return step == 2 ? nan : 1.0; });
  const auto outcome = run(stepper);
  EXPECT_EQ(outcome.status, RunStatus::numerical_failure);
  EXPECT_NE(outcome.reason.find("not a number after step 2"), std::string::npos) << outcome.reason;
  // the bad state is not shown as a step
  EXPECT_EQ(std::count(lines_.begin(), lines_.end(), "a2"), 0);
  EXPECT_EQ(lines_.back(), "b end 2");
}

TEST_F(RelaxTest, FinishesTheObserversBeforeAnExceptionLeaves) {
  FakeStepper stepper(steady);
  stepper.on_step = [](long step) {
    if (step == 2) throw std::runtime_error("out of memory");
  };
  EXPECT_THROW((void)run(stepper), std::runtime_error);
  EXPECT_EQ(lines_.back(), "b end 1");
  EXPECT_EQ(first_.reason, "out of memory");
}

}  // namespace
}  // namespace vesica::relax
