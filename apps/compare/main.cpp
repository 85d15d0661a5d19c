#include <filesystem>
#include <iostream>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "common/guarded.hpp"
#include "common/run_case.hpp"
#include "common/signals.hpp"
#include "prepare.hpp"
#include "vesica/compare/comparison.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/relax/interrupt_controller.hpp"

namespace vesica {
namespace {

namespace fs = std::filesystem;

/// Writes to `folder` unless it is empty, and prints.
int conclude(std::vector<compare::ComparedRun> runs, const fs::path& folder, bool is_quiet) {
  const compare::Comparison comparison = compare::compare(std::move(runs));
  if (!is_quiet) io::print_comparison(std::cout, comparison);
  if (folder.empty()) return compare::exit_status(comparison);
  io::create_run_folder(folder);
  io::write_comparison(folder, comparison);
  if (const auto failure = io::draw_comparison(folder))
    std::cerr << "warning: " << *failure << '\n';
  if (!is_quiet) io::print_comparison_files(std::cout, comparison, folder);
  return compare::exit_status(comparison);
}

int compare_methods(const Arguments& arguments) {
  std::vector<compare::ComparedRun> results;
  PreparedComparison prepared = prepare(arguments);
  relax::InterruptController interrupt(catch_signals());
  for (PreparedRun& run : prepared.runs) {
    if (!arguments.options.is_quiet) std::cout << run.name << ":\n";
    RunResult result = run_case(run.config, run.vesicle, interrupt, arguments.options.is_quiet);
    if (result.verdict.outcome.status == relax::RunStatus::interrupted) {
      std::cerr << "vesica-compare: interrupted in the run " << run.name
                << ", which is saved; nothing was compared\n";
      return relax::exit_status(result.verdict.outcome);
    }
    results.push_back({run.name, run.config.output.directory, std::move(run.vesicle.model),
                       std::move(result.state), std::move(result.verdict),
                       io::read_history(run.config.output.directory)});
  }
  return conclude(std::move(results), prepared.folder, arguments.options.is_quiet);
}

int compare_folders(const Arguments& arguments) {
  const fs::path folder = arguments.options.directory;
  if (!folder.empty()) io::check_comparison_folder(folder, arguments.options.overwrites);
  return conclude(io::read_runs(arguments.inputs[0], arguments.inputs[1]), folder,
                  arguments.options.is_quiet);
}

}  // namespace
}  // namespace vesica

int main(int argc, char** argv) {
  using namespace vesica;
  admit_signals();
  return guarded("vesica-compare", [&] {
    const ParsedCommandLine command_line = parse_command_line(argc, argv);
    if (!command_line.arguments) return command_line.status;
    const Arguments& arguments = *command_line.arguments;
    return arguments.inputs.size() == 1 ? compare_methods(arguments) : compare_folders(arguments);
  });
}
