#include "run_case.hpp"

#include <unistd.h>

#include <array>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "signals.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/progress.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/trajectory_writer.hpp"
#include "vesica/relax/damping_controller.hpp"
#include "vesica/relax/make_mesh_controller.hpp"
#include "vesica/relax/neck_controller.hpp"
#include "vesica/relax/relax.hpp"
#include "vesica/relax/self_intersection_controller.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica {
namespace {

relax::Outcome compute(const config::RunConfig& config, const setup::Case& vesicle,
                       std::unique_ptr<solve::Stepper>& stepper, relax::Controller& interrupt,
                       bool is_quiet) {
  const auto style =
      ::isatty(STDOUT_FILENO) != 0 ? io::ProgressStyle::rewriting : io::ProgressStyle::sparse;
  io::Progress progress(std::cout, is_quiet ? io::ProgressStyle::none : style);
  io::TrajectoryWriter trajectory(config.output.directory, config, vesicle);
  const problem::Scales scales = problem::scales_of(vesicle.model, vesicle.start);
  relax::DampingController damping(config.damping, scales);
  const auto mesh = relax::make_mesh_controller(config.adaption, vesicle.model, scales);
  relax::NeckController neck(vesicle.model, scales);
  relax::SelfIntersectionController intersection(config.output.every_steps);
  const std::array<relax::Observer*, 2> observers{&progress, &trajectory};
  std::vector<relax::Controller*> controllers{&damping, &interrupt, &neck, &intersection};
  if (config.adaption.enabled) controllers.push_back(mesh.get());
  const auto restart = [&](problem::State start, const solve::Restart& how) {
    return run::restart_stepper(config.solver, vesicle.model, std::move(start), how);
  };
  return relax::relax(stepper, restart, vesicle.model, config.stop, observers, controllers);
}

RunResult relaxed(const config::RunConfig& config, const setup::Case& vesicle,
                  relax::Controller& interrupt, bool is_quiet) {
  std::unique_ptr<solve::Stepper> stepper;
  try {
    const DelayedSignals delayed;
    stepper = run::make_stepper(config.solver, vesicle.model, vesicle.start);
  } catch (const SolverError& error) {
    return {relax::make_verdict(io::record_failed_start(config, vesicle, error.what()),
                                config.solver, vesicle.model, vesicle.start),
            vesicle.start};
  }
  io::create_run_folder(config.output.directory);
  relax::Outcome outcome = compute(config, vesicle, stepper, interrupt, is_quiet);
  return {relax::make_verdict(std::move(outcome), config.solver, vesicle.model, stepper->state()),
          stepper->state()};
}

}  // namespace

void check_run(const config::RunConfig& config, const std::string& case_file, bool overwrites) {
  io::check_run_folder(config.output.directory, case_file, overwrites);
  (void)relax::resolved_damping(config.damping);
}

RunResult run_case(const config::RunConfig& config, const setup::Case& vesicle,
                   relax::Controller& interrupt, bool is_quiet) {
  RunResult result = relaxed(config, vesicle, interrupt, is_quiet);
  io::write_verdict(config, result.verdict);
  return result;
}

}  // namespace vesica
