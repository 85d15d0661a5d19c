#include <unistd.h>

#include <array>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "signals.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/case.hpp"
#include "vesica/io/config.hpp"
#include "vesica/io/progress.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/trajectory_writer.hpp"
#include "vesica/io/verdict.hpp"
#include "vesica/relax/interrupt_controller.hpp"
#include "vesica/relax/relax.hpp"
#include "vesica/solve/make_stepper.hpp"

namespace vesica {
namespace {

relax::Outcome compute(const io::RunConfig& config, const io::Case& vesicle,
                       solve::Stepper& stepper, relax::Controller& interrupt, bool is_quiet) {
  const auto style =
      ::isatty(STDOUT_FILENO) != 0 ? io::ProgressStyle::rewriting : io::ProgressStyle::sparse;
  io::Progress progress(std::cout, is_quiet ? io::ProgressStyle::none : style);
  io::TrajectoryWriter trajectory(config.output.directory, config, vesicle.model);
  relax::DampingController damping(config.damping,
                                   problem::scales_of(vesicle.model, vesicle.start));
  const std::array<relax::Observer*, 2> observers{&progress, &trajectory};
  const std::array<relax::Controller*, 2> controllers{&damping, &interrupt};
  return relax::relax(stepper, vesicle.model, config.stop, observers, controllers);
}

io::Verdict relaxed(const io::RunConfig& config, const io::Case& vesicle,
                    relax::Controller& interrupt, bool is_quiet) {
  const std::string_view method = name_of(config.solver.method);
  std::unique_ptr<solve::Stepper> stepper;
  try {
    const DelayedSignals delayed;
    stepper = solve::make_stepper(config.solver, vesicle.model, vesicle.start);
  } catch (const SolverError& error) {
    return io::make_verdict(io::record_failed_start(config, vesicle, error.what()), method,
                            vesicle.model, vesicle.start);
  }
  io::create_run_folder(config.output.directory);
  relax::Outcome outcome = compute(config, vesicle, *stepper, interrupt, is_quiet);
  return io::make_verdict(std::move(outcome), method, vesicle.model, stepper->state());
}

int run(const Arguments& arguments) {
  const io::RunConfig config = read_config(arguments);
  io::check_run_folder(config.output.directory, arguments.case_file, arguments.overwrites);
  (void)relax::resolved_damping(config.damping);
  const io::Case vesicle = io::make_case(config);
  for (const std::string& warning : vesicle.warnings) std::cerr << "warning: " << warning << '\n';
  relax::InterruptController interrupt(catch_signals());
  const io::Verdict verdict = relaxed(config, vesicle, interrupt, arguments.is_quiet);
  io::write_verdict(config, verdict);
  if (!arguments.is_quiet) {
    io::print_verdict(std::cout, verdict);
    io::print_files(std::cout, config);
  }
  return io::exit_status(verdict.outcome);
}

int fail(const std::exception& error, int status) {
  std::cerr << "vesica-relax: " << error.what() << '\n';
  return status;
}

}  // namespace
}  // namespace vesica

int main(int argc, char** argv) {
  using namespace vesica;
  admit_signals();
  try {
    const ParsedCommandLine command_line = parse_command_line(argc, argv);
    return command_line.arguments ? run(*command_line.arguments) : command_line.status;
  } catch (const ConfigError& error) {
    return fail(error, 2);
  } catch (const IoError& error) {
    return fail(error, 4);
  } catch (const std::exception& error) {
    return fail(error, 3);
  }
}
