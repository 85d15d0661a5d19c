#include "vesica/relax/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

namespace vesica::relax {

namespace {

/// One run; its members are what the steps of the loop share.
class Run {
 public:
  Run(solve::Stepper& stepper, const model::Model& model, const StopOptions& stop,
      std::span<Observer* const> observers, std::span<Controller* const> controllers)
      : stepper_(stepper),
        model_(model),
        stop_(stop),
        observers_(observers),
        controllers_(controllers),
        stationarity_(stop, model) {
    report_.time = stepper.state().time;
  }

  Outcome execute() {
    measure();
    outcome_.initial_quality = outcome_.smallest_quality = diagnostics_.quality;
    std::optional<Stop> end = look_and_respond();
    while (!end) {
      report_ = timed([&] { return stepper_.step(stop_.end_time); });
      if (report_.status == solve::StepStatus::failed) {
        end = Stop{RunStatus::numerical_failure, report_.reason};
        break;
      }
      measure();
      end = find_nonsense();
      if (!end) end = look_and_respond();
    }
    return conclude(*end);
  }

  /// For the way out through an exception: observers complete what they have.
  void abandon(const std::string& reason) { conclude({RunStatus::numerical_failure, reason}); }

 private:
  [[nodiscard]] StepView view() const { return {stepper_.state(), report_, diagnostics_}; }

  /// Adds the processor seconds of a call of the stepper to those before it.
  template <class Call>
  solve::StepReport timed(Call&& call) {
    const std::clock_t start = std::clock();
    solve::StepReport report = call();
    processor_seconds_ += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    report.seconds.processor = processor_seconds_;
    return report;
  }

  void measure() {
    diagnostics_ = problem::measure(model_, stepper_.state());
    if (const auto energy = stepper_.energy()) diagnostics_.energy = *energy;
    outcome_.smallest_quality = std::min(outcome_.smallest_quality, diagnostics_.quality);
  }

  [[nodiscard]] std::optional<Stop> find_nonsense() const {
    if (std::isfinite(diagnostics_.energy.total()) && std::isfinite(diagnostics_.velocity.normal))
      return std::nullopt;
    return Stop{
        RunStatus::numerical_failure,
        fmt::format("energy or velocity is not a number after step {}", report_.counts.steps)};
  }

  std::optional<Stop> look_and_respond() {
    for (auto* observer : observers_) observer->observe(view());
    std::optional<Stop> end;
    for (auto* controller : controllers_) {
      for (const auto& request : controller->respond(view())) {
        if (const auto* damping = std::get_if<SetDamping>(&request))
          stepper_.set_damping(damping->alpha);
        if (const auto* stop = std::get_if<Stop>(&request); stop && !end) end = *stop;
      }
    }
    if (!end && report_.counts.steps > 0 && stationarity_.is_at_rest(view())) end = try_to_finish();
    if (!end) end = stationarity_.limit(view());
    return end;
  }

  /// The state rests: take the constraints to round-off, then look at all criteria once more. When
  /// that does not work (dependent constraints, as on a sphere), the constraints of the step count.
  std::optional<Stop> try_to_finish() {
    const auto report = timed([&] { return stepper_.finish(); });
    if (report.status == solve::StepStatus::accepted) {
      report_ = report;
      measure();
    }
    if (!stationarity_.meets_velocity(view()) || !stationarity_.meets_constraints(diagnostics_)) {
      return std::nullopt;
    }
    if (report_.gradient) {
      return Stop{RunStatus::converged,
                  fmt::format("distance to the minimum {:.2e} below {:g}, constraints met",
                              *report_.gradient, stop_.gradient)};
    }
    return Stop{
        RunStatus::converged,
        fmt::format("normal velocity {:.2e} below {:g}, multipliers at rest, constraints met",
                    diagnostics_.velocity.normal_rigid_free, stop_.normal_velocity)};
  }

  Outcome conclude(const Stop& end) {
    outcome_.status = end.status;
    outcome_.reason = end.reason;
    outcome_.signal = end.signal;
    outcome_.diagnostics = diagnostics_;
    outcome_.report = report_;
    for (auto* observer : observers_) observer->finish(view(), outcome_);
    return outcome_;
  }

  solve::Stepper& stepper_;
  const model::Model& model_;
  const StopOptions& stop_;
  std::span<Observer* const> observers_;
  std::span<Controller* const> controllers_;
  Stationarity stationarity_;
  double processor_seconds_ = 0;
  solve::StepReport report_;
  problem::Diagnostics diagnostics_;
  Outcome outcome_;
};

}  // namespace

Outcome relax(solve::Stepper& stepper, const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers) {
  Run run(stepper, model, stop, observers, controllers);
  try {
    return run.execute();
  } catch (const std::exception& error) {
    run.abandon(error.what());
    throw;
  }
}

}  // namespace vesica::relax
