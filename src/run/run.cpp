#include "vesica/run/run.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "start_care.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/io/trajectory_writer.hpp"
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

/// Whether the run that is resumed goes on in its own folder.
bool goes_on_in_place(const config::RunConfig& config, const Options& options) {
  std::error_code ignored;
  return !options.resumed.empty() &&
         std::filesystem::equivalent(options.resumed, config.output.directory, ignored);
}

void check(const config::RunConfig& config, const Options& options) {
  if (options.writes_files) {
    const bool in_place = goes_on_in_place(config, options);
    io::check_run_folder(config.output.directory,
                         in_place ? std::filesystem::path() : options.case_file,
                         options.overwrites || in_place);
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

/// Runs the loop with `observers`, of which the first writes files if there are any, and the
/// controllers of run.hpp.
relax::Outcome compute(const config::RunConfig& config, const setup::Case& vesicle,
                       const Options& options, Observers observers,
                       std::unique_ptr<solve::Stepper>& stepper) {
  std::optional<io::Progress> progress;
  if (options.progress != nullptr) {  // behind the files: what it tells of is on the disk
    const auto behind_files = observers.begin() + (options.writes_files ? 1 : 0);
    observers.insert(behind_files, &progress.emplace(*options.progress, options.progress_style));
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
  return relax::relax(stepper, restart, vesicle.model, config.stop, observers, controllers);
}

/// A run that is resumed goes on as on a new mesh: with its rates and, the history of the
/// integrator being lost, with a part of its last step. Where the rates no longer hold they are
/// found anew.
std::unique_ptr<solve::Stepper> first_stepper(const config::RunConfig& config,
                                              const setup::Case& vesicle, FitStart& start) {
  constexpr double part_of_last_step = 0.3;
  const double step_size = vesicle.resumed ? vesicle.resumed->step_size : 0;
  if (step_size > 0 && config.solver.method == solve::Method::ida)
    return restart_stepper(config.solver, vesicle.model, vesicle.start,
                           {part_of_last_step * step_size});
  return make_stepper_somehow(config.solver, vesicle.model, start);
}

Result relaxed(const config::RunConfig& config, const setup::Case& vesicle,
               const Options& options) {
  std::unique_ptr<solve::Stepper> stepper;
  std::string failure;
  FitStart start{vesicle.start};
  try {
    if (!vesicle.resumed) {
      start = near_targets(vesicle, config.solver, options.interrupt);
      if (config.adaption.enabled) smooth_before_adaption(config.solver, vesicle.model, start);
    }
    stepper = first_stepper(config, vesicle, start);
    stepper->set_notes(std::move(start.notes));
  } catch (const SolverError& error) {
    failure = error.what();
  }
  Observers observers = options.observers;
  std::optional<io::TrajectoryWriter> trajectory;
  if (options.writes_files) {
    io::create_run_folder(config.output.directory);
    const bool replaces = options.overwrites || goes_on_in_place(config, options);
    observers.insert(observers.begin(),
                     &trajectory.emplace(config.output.directory, config, vesicle, replaces));
  }
  relax::Outcome outcome;
  if (stepper) {
    outcome = compute(config, vesicle, options, std::move(observers), stepper);
  } else {
    outcome = outcome_of_failed_start(vesicle, std::move(failure));
    for (auto* observer : observers)
      observer->finish({vesicle.start, outcome.report, outcome.diagnostics}, outcome);
  }
  const problem::State& state = stepper ? stepper->state() : vesicle.start;
  if (trajectory && trajectory->verdict()) return {*trajectory->verdict(), state, vesicle.warnings};
  Result result{relax::make_verdict(std::move(outcome), config.solver, vesicle.model, state), state,
                vesicle.warnings};
  result.verdict.warnings = vesicle.warnings;
  return result;
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
    return relaxed(config, vesicle, options);
  });
}

}  // namespace vesica::run
