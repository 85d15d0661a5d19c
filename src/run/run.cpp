#include "vesica/run/run.hpp"

#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "start_care.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/io/trajectory_writer.hpp"
#include "vesica/io/verdict_files.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/damping_controller.hpp"
#include "vesica/relax/interrupt_controller.hpp"
#include "vesica/relax/make_mesh_controller.hpp"
#include "vesica/relax/neck_controller.hpp"
#include "vesica/relax/relax.hpp"
#include "vesica/relax/self_intersection_controller.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica::run {
namespace {

void check(const config::RunConfig& config, const Options& options) {
  if (options.writes_files) {
    io::check_run_folder(config.output.directory, options.case_file.string(), options.overwrites);
  }
  (void)relax::resolved_damping(config.damping);
}

/// The outcome of a run whose stepper could not be made: energies and velocities are not known.
relax::Outcome outcome_of_failed_start(const setup::Case& vesicle, std::string reason) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  relax::Outcome outcome;
  outcome.status = relax::RunStatus::numerical_failure;
  outcome.reason = std::move(reason);
  outcome.diagnostics = measure::measure(vesicle.model, vesicle.start);
  outcome.diagnostics.energy = {unknown, unknown, std::nullopt};
  outcome.diagnostics.velocity = {unknown, unknown, unknown};
  outcome.report.status = solve::StepStatus::failed;
  outcome.initial_quality = outcome.diagnostics.quality;
  outcome.smallest_quality = outcome.diagnostics.quality;
  return outcome;
}

using Observers = std::vector<relax::Observer*>;

/// Tells the observers what was done to the start, and returns it as events.
std::vector<relax::Event> announced(const std::vector<std::string>& notes,
                                    const setup::Case& vesicle, const problem::State& state,
                                    const Observers& observers) {
  std::vector<relax::Event> events;
  if (notes.empty()) return events;
  const measure::Diagnostics diagnostics = measure::measure(vesicle.model, state);
  for (const std::string& note : notes) {
    events.push_back({0, state.time, note});
    for (auto* observer : observers) observer->happened({state, {}, diagnostics}, events.back());
  }
  return events;
}

/// The stepper of a run, and what was done to its start.
struct Beginning {
  std::unique_ptr<solve::Stepper>& stepper;
  const std::vector<std::string>& notes;
};

/// Runs the loop with `observers` behind the progress, and the controllers of run.hpp.
relax::Outcome compute(const config::RunConfig& config, const setup::Case& vesicle,
                       const Options& options, Observers observers, const Beginning& beginning) {
  std::optional<io::Progress> progress;
  if (options.progress != nullptr) {
    observers.insert(observers.begin(),
                     &progress.emplace(*options.progress, options.progress_style));
  }
  const problem::Scales scales = problem::scales_of(vesicle.model, vesicle.start);
  relax::DampingController damping(config.damping, scales);
  std::optional<relax::InterruptController> interrupt;
  relax::NeckController neck(vesicle.model, scales);
  relax::SelfIntersectionController intersection(config.output.every_steps);
  const auto mesh = relax::make_mesh_controller(config.adaption, vesicle.model, scales);
  std::vector<relax::Controller*> controllers{&damping};
  if (options.interrupt != nullptr) controllers.push_back(&interrupt.emplace(*options.interrupt));
  controllers.insert(controllers.end(), options.controllers.begin(), options.controllers.end());
  controllers.insert(controllers.end(), {&neck, &intersection});
  if (config.adaption.enabled) controllers.push_back(mesh.get());
  const auto restart = [&](problem::State start, const solve::Restart& how) {
    return restart_stepper(config.solver, vesicle.model, std::move(start), how);
  };
  auto events = announced(beginning.notes, vesicle, beginning.stepper->state(), observers);
  auto outcome =
      relax::relax(beginning.stepper, restart, vesicle.model, config.stop, observers, controllers);
  outcome.events.insert(outcome.events.begin(), std::make_move_iterator(events.begin()),
                        std::make_move_iterator(events.end()));
  return outcome;
}

Result relaxed(const config::RunConfig& config, const setup::Case& vesicle,
               const Options& options) {
  std::unique_ptr<solve::Stepper> stepper;
  std::string failure;
  FitStart start{vesicle.start};
  try {
    start = near_targets(vesicle, config.solver, options.interrupt);
    stepper = make_stepper_somehow(config.solver, vesicle.model, start);
  } catch (const SolverError& error) {
    failure = error.what();
  }
  Observers observers = options.observers;
  std::optional<io::TrajectoryWriter> trajectory;
  if (options.writes_files) {
    io::create_run_folder(config.output.directory);
    observers.insert(observers.begin(),
                     &trajectory.emplace(config.output.directory, config, vesicle));
  }
  relax::Outcome outcome;
  if (stepper) {
    outcome = compute(config, vesicle, options, std::move(observers), {stepper, start.notes});
  } else {
    outcome = outcome_of_failed_start(vesicle, std::move(failure));
    for (auto* observer : observers)
      observer->finish({vesicle.start, outcome.report, outcome.diagnostics}, outcome);
  }
  const problem::State& state = stepper ? stepper->state() : vesicle.start;
  return {relax::make_verdict(std::move(outcome), config.solver, vesicle.model, state), state,
          vesicle.warnings};
}

}  // namespace

setup::Case prepare(const config::RunConfig& given, const Options& options) {
  const config::RunConfig config = config::resolved(given);
  return config::with_places(config, [&] {
    check(config, options);
    return options.resumed.empty() ? setup::make_case(config)
                                   : io::resumed_case(config, options.resumed);
  });
}

Result run(const config::RunConfig& config, const Options& options) {
  return run(config, prepare(config, options), options);
}

Result run(const config::RunConfig& given, const setup::Case& vesicle, const Options& options) {
  const config::RunConfig config = config::resolved(given);
  return config::with_places(config, [&] {
    check(config, options);
    Result result = relaxed(config, vesicle, options);
    if (options.writes_files) io::write_verdict(config, result.verdict);
    return result;
  });
}

}  // namespace vesica::run
