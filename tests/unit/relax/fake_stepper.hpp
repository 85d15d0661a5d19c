#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "relaxation_cases.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::relax {

/// Steps of time 1 of a unit sphere that stays where it is but claims to inflate, at a speed that
/// is a function of the step.
class FakeStepper final : public solve::Stepper {
 public:
  explicit FakeStepper(std::function<double(long step)> speed) : speed_(std::move(speed)) {
    const auto sphere = test::make_sphere(1);
    state_ = test::start_on(sphere);
    state_.values.mean_curvature.setConstant(-2);
    state_.rates = state_.values;
    state_.damping = 1;
    move();
  }

  [[nodiscard]] const problem::State& state() const override { return state_; }

  solve::StepReport step(double end_time) override {
    if (on_step) on_step(counts_.steps + 1);
    if (counts_.steps + 1 == failing_step) {
      solve::StepReport report = make_report();
      report.status = solve::StepStatus::failed;
      report.reason = "the fake fails";
      return report;
    }
    ++counts_.steps;
    state_.time = std::min(state_.time + 1, end_time);
    move();
    return make_report();
  }

  solve::StepReport finish() override {
    ++finished;
    solve::StepReport report = make_report();
    if (finish_fails) report.status = solve::StepStatus::failed;
    return report;
  }

  void set_damping(double alpha) override {
    state_.damping = alpha;
    dampings.push_back(alpha);
  }

  std::function<void(long step)> on_step;
  long failing_step = -1;
  int finished = 0;
  bool finish_fails = false;
  std::vector<double> dampings;

 private:
  void move() { state_.rates.positions = speed_(counts_.steps) * state_.values.positions; }

  [[nodiscard]] solve::StepReport make_report() const {
    solve::StepReport report;
    report.time = state_.time;
    report.step_size = 1;
    report.counts = counts_;
    return report;
  }

  std::function<double(long)> speed_;
  problem::State state_;
  solve::SolverCounts counts_;
};

/// One phase, nothing constrained.
inline model::Model free_model() {
  model::Model model;
  model.is_two_phase = false;
  return model;
}

}  // namespace vesica::relax
