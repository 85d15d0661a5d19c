#include "vesica/relax/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "processor_timer.hpp"
#include "stepper_slot.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/scoped_timer.hpp"
#include "vesica/relax/decay_watch.hpp"
#include "vesica/relax/domain_watch.hpp"
#include "vesica/relax/remesh.hpp"

namespace vesica::relax {
namespace {

constexpr double restart_step = 0.3;  // of the last step, on a new mesh
constexpr double retry_step = 0.03;   // the same after a failure

std::string description(const MeshChange& change) {
  return fmt::format("remeshed: {} -> {} nodes, quality {:.2f} -> {:.2f}, because {}",
                     change.nodes_before, change.nodes_after, change.quality_before,
                     change.quality_after, change.reason);
}

/// One run; its members are what the steps of the loop share.
class Run {
 public:
  Run(StepperSlot stepper, const model::Model& model, const StopOptions& stop,
      std::span<Observer* const> observers, std::span<Controller* const> controllers)
      : stepper_(stepper),
        model_(model),
        stop_(stop),
        observers_(observers),
        controllers_(controllers),
        stationarity_(stop, model),
        decay_(model),
        domains_(model.material.interface_width) {
    report_.time = state().time;
  }

  Outcome execute() {
    measure();
    outcome_.initial_quality = outcome_.smallest_quality = diagnostics_.quality;
    for (const std::string& note : stepper_.current->notes())
      record({report_.counts.steps, state().time, note});
    std::optional<Stop> end = look_and_respond();
    while (!end) {
      report_ = stepped([&] { return stepper_.current->step(stop_.end_time); });
      if (report_.status == solve::StepStatus::failed) {
        end = respond_to_failure();
        continue;
      }
      step_size_ = report_.step_size;
      measure();
      record_event();
      end = find_nonsense();
      if (!end) end = find_decay();
      if (!end) end = look_and_respond();
    }
    return conclude(*end);
  }

  /// For the way out through an exception: observers complete what they have, and may not hide it.
  void abandon(const std::string& reason) noexcept try {
    if (outcome_.reason.empty()) conclude({RunStatus::numerical_failure, reason});
  } catch (const std::exception&) {
  }

 private:
  [[nodiscard]] const problem::State& state() const { return stepper_.current->state(); }
  [[nodiscard]] StepView view() const { return {state(), report_, diagnostics_}; }

  /// A report of the stepper with the work of controllers and of steppers before it.
  template <class Call>
  solve::StepReport stepped(Call&& call) {
    solve::StepReport report;
    {
      const ProcessorTimer timer(processor_seconds_);
      report = call();
    }
    counts_ = report.counts;
    seconds_ = report.seconds;
    report.counts += earlier_counts_;
    report.seconds += earlier_seconds_;
    report.seconds.processor = processor_seconds_;
    return report;
  }

  /// What a controller asks for costs seconds, too.
  template <class Call>
  auto controlled(Call&& call) {
    const ScopedTimer timer(earlier_seconds_.total);
    const ProcessorTimer processor_timer(processor_seconds_);
    return call();
  }

  void measure() {
    diagnostics_ = measure::measure(model_, state());
    if (const auto energy = stepper_.current->energy()) diagnostics_.energy = *energy;
    outcome_.smallest_quality = std::min(outcome_.smallest_quality, diagnostics_.quality);
  }

  [[nodiscard]] std::optional<Stop> find_nonsense() const {
    if (std::isfinite(diagnostics_.energy.total()) && std::isfinite(diagnostics_.velocity.normal))
      return std::nullopt;
    return Stop{
        RunStatus::numerical_failure,
        fmt::format("energy or velocity is not a number after step {}", report_.counts.steps)};
  }

  /// Goes back to the state of least energy where the mesh decays.
  std::optional<Stop> find_decay() {
    if (!decay_.has_decayed(view())) return std::nullopt;
    if (stepper_.factory != nullptr) {
      stepper_.replace(decay_.best(), {restart_step * step_size_});
      measure();
    }
    return decay_.stop();
  }

  std::optional<Stop> look_and_respond() {
    for (auto* observer : observers_) observer->observe(view());
    for (const Event& event : domains_.look(view())) record(event);
    const Answers answers = ask(&Controller::respond);
    if (answers.stop) return answers.stop;
    if (change_mesh(answers.remesh, restart_step)) return respond_to_limit();
    std::optional<Stop> end;
    if (report_.counts.steps > 0 && stationarity_.is_at_rest(view())) end = respond_to_rest();
    return end ? end : respond_to_limit();
  }

  using Response = std::vector<Request> (Controller::*)(const StepView& view);

  /// The first of each kind.
  struct Answers {
    std::optional<Stop> stop;
    std::optional<Remesh> remesh;
  };

  /// Asks all controllers, in order, and sets the damping that they want.
  Answers ask(Response response) {
    Answers answers;
    for (auto* controller : controllers_) {
      for (const auto& request : controlled([&] { return (controller->*response)(view()); })) {
        if (const auto* damping = std::get_if<SetDamping>(&request))
          stepper_.current->set_damping(damping->alpha);
        if (const auto* stop = std::get_if<Stop>(&request); stop && !answers.stop)
          answers.stop = *stop;
        if (const auto* remesh = std::get_if<Remesh>(&request); remesh && !answers.remesh)
          answers.remesh = *remesh;
      }
    }
    return answers;
  }

  std::optional<Stop> respond_to_failure() {
    const std::string failure = report_.reason;
    const Answers answers = ask(&Controller::respond_to_failure);
    if (answers.stop && answers.stop->status == RunStatus::interrupted) return answers.stop;
    if (const auto limit = respond_to_limit()) return limit;
    if (change_mesh(answers.remesh, retry_step)) return std::nullopt;
    const auto cause = answers.stop ? answers.stop : Stationarity::unresolved(state());
    return explained({RunStatus::numerical_failure, failure}, cause);
  }

  std::optional<Stop> respond_to_limit() {
    const std::optional<Stop> limit = stationarity_.limit(view());
    if (!limit) return std::nullopt;
    return explained(*limit, ask(&Controller::respond_to_limit).stop);
  }

  std::optional<Stop> respond_to_rest() {
    const Answers answers = ask(&Controller::respond_to_rest);
    if (answers.stop) return answers.stop;
    if (change_mesh(answers.remesh, restart_step)) return std::nullopt;
    return try_to_finish();
  }

  /// The end of a run with what is behind it.
  static Stop explained(const Stop& end, const std::optional<Stop>& cause) {
    if (!cause) return end;
    return {cause->status, fmt::format("{}; then {}", cause->reason, end.reason)};
  }

  /// A new mesh and a new stepper; false when none is asked for or it is worse than none.
  bool change_mesh(const std::optional<Remesh>& wanted, double step_factor) {
    if (!wanted) return false;
    const Remesh& remesh = *wanted;
    if (stepper_.factory == nullptr)
      throw ConfigError("relax: a new mesh is asked for: needs a factory of steppers");
    auto changed = controlled([&] { return remeshed(model_, state(), remesh); });
    if (!changed) return false;
    MeshChange change{report_.counts.steps,
                      state().time,
                      state().triangulation->num_nodes(),
                      changed->triangulation->num_nodes(),
                      diagnostics_.quality,
                      0,
                      remesh.reason};
    step_size_ *= step_factor;
    stepper_.replace(std::move(*changed), {step_size_});
    report_.status = solve::StepStatus::accepted;
    earlier_counts_ += std::exchange(counts_, {});
    earlier_seconds_ += std::exchange(seconds_, {});
    stationarity_.forget_steps();
    decay_.forget();
    measure();
    change.quality_after = diagnostics_.quality;
    outcome_.mesh_changes.push_back(change);
    for (auto* observer : observers_) observer->mesh_changed(view(), change);
    record({change.step, change.time, description(change)});
    return true;
  }

  /// What the stepper reports.
  void record_event() {
    if (!report_.event.empty()) record({report_.counts.steps, state().time, report_.event});
  }

  void record(const Event& event) {
    outcome_.events.push_back(event);
    for (auto* observer : observers_) observer->happened(view(), event);
  }

  /// The state rests: take the constraints to round-off, then look at all criteria once more. When
  /// that does not work (dependent constraints, as on a sphere), the constraints of the step count.
  std::optional<Stop> try_to_finish() {
    const auto report = stepped([&] { return stepper_.current->finish(); });
    if (report.status == solve::StepStatus::accepted) {
      report_ = report;
      measure();
      record_event();
    }
    const std::string found = report.reason.empty() ? "" : "; " + report.reason;
    if (!stationarity_.meets_velocity(view()) || !stationarity_.meets_constraints(diagnostics_))
      return std::nullopt;
    if (const auto unresolved = Stationarity::unresolved(state())) return unresolved;
    return Stop{RunStatus::converged, stationarity_.rest_text(view()) + found};
  }

  Outcome conclude(const Stop& end) {
    for (const Event& event : domains_.finish()) record(event);
    outcome_.status = end.status;
    outcome_.reason = end.reason;
    outcome_.signal = end.signal;
    outcome_.diagnostics = diagnostics_;
    outcome_.report = report_;
    for (auto* observer : observers_) observer->finish(view(), outcome_);
    return outcome_;
  }

  StepperSlot stepper_;
  const model::Model& model_;
  const StopOptions& stop_;
  std::span<Observer* const> observers_;
  std::span<Controller* const> controllers_;
  Stationarity stationarity_;
  DecayWatch decay_;
  DomainWatch domains_;
  double processor_seconds_ = 0;
  solve::StepReport report_;
  solve::SolverCounts counts_;  // of the present stepper
  solve::SolverSeconds seconds_;
  solve::SolverCounts earlier_counts_;    // of steppers on earlier meshes
  solve::SolverSeconds earlier_seconds_;  // and of controllers
  double step_size_ = 0;                  // of the last step, or with which the stepper begins
  measure::Diagnostics diagnostics_;
  Outcome outcome_;
};

Outcome execute(Run& run) {
  try {
    return run.execute();
  } catch (const std::exception& error) {
    run.abandon(error.what());
    throw;
  }
}

}  // namespace

Outcome relax(solve::Stepper& stepper, const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers) {
  Run run({&stepper}, model, stop, observers, controllers);
  return execute(run);
}

Outcome relax(std::unique_ptr<solve::Stepper>& stepper, const StepperFactory& restart,
              const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers) {
  Run run({stepper.get(), &stepper, &restart}, model, stop, observers, controllers);
  return execute(run);
}

}  // namespace vesica::relax
