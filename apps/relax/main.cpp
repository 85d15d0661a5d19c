#include <filesystem>
#include <iostream>
#include <system_error>

#include "arguments.hpp"
#include "common/program.hpp"
#include "vesica/config/config.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/io/surface_writer.hpp"
#include "vesica/io/verdict_files.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/run/run.hpp"
#include "vesica/setup/case.hpp"

namespace vesica {
namespace {

/// Neither looks at the output folder nor makes it.
int write_start(const config::RunConfig& config, const Arguments& arguments) {
  run::Options options;
  options.writes_files = false;
  options.resumed = arguments.resumed;
  const setup::Case vesicle = run::prepare(config, options);
  print_warnings(vesicle.warnings);
  const problem::State& start = vesicle.start;
  io::write_surface(arguments.start_file, start.surface(), io::fields_of(start));
  if (!arguments.options.is_quiet) {
    std::cout << arguments.start_file << ": " << start.triangulation->num_nodes() << " nodes, "
              << start.triangulation->num_triangles() << " triangles\n";
  }
  return 0;
}

bool goes_on_in_place(const config::RunConfig& config, const Arguments& arguments) {
  std::error_code ignored;
  return !arguments.resumed.empty() &&
         std::filesystem::equivalent(config.output.directory, arguments.resumed, ignored);
}

/// Says that a run has nothing left to do.
int conclude(const relax::Verdict& verdict, const Arguments& arguments) {
  if (!arguments.options.is_quiet) {
    std::cout << arguments.resumed << ": the run has converged at t = " << verdict.time << ": "
              << verdict.outcome.reason << "; nothing is left to do\n";
  }
  return relax::exit_status(verdict.outcome);
}

int relax_case(const config::RunConfig& config, const Arguments& arguments) {
  run::Options options = library_options(arguments.options, arguments.case_file);
  options.resumed = arguments.resumed;
  const setup::Case vesicle = run::prepare(config, options);
  print_warnings(vesicle.warnings);
  if (config.solver.method == solve::Method::automatic && !arguments.options.is_quiet) {
    const config::MethodChoice choice = config::choose_method(config);
    std::cout << "solver.method = auto: " << name_of(choice.method) << ", since " << choice.reason
              << '\n';
  }
  options.interrupt = &catch_signals();
  const relax::Verdict verdict = run::run(config, vesicle, options).verdict;
  if (!arguments.options.is_quiet) {
    io::print_verdict(std::cout, verdict);
    io::print_files(std::cout, config);
  } else if (verdict.outcome.status == relax::RunStatus::numerical_failure) {
    std::cerr << "vesica-relax: numerical failure: " << verdict.outcome.reason << '\n';
  }
  return relax::exit_status(verdict.outcome);
}

}  // namespace
}  // namespace vesica

int main(int argc, char** argv) {
  using namespace vesica;
  return run_program("vesica-relax", [&] {
    const ParsedCommandLine command_line = parse_command_line(argc, argv);
    if (!command_line.arguments) return command_line.status;
    const Arguments& arguments = *command_line.arguments;
    const config::RunConfig config = read_config(arguments);
    if (!arguments.start_file.empty()) return write_start(config, arguments);
    if (goes_on_in_place(config, arguments)) {
      if (const auto verdict = io::find_conclusion(config, arguments.resumed))
        return conclude(*verdict, arguments);
    }
    return relax_case(config, arguments);
  });
}
