#include <filesystem>
#include <iostream>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "common/program.hpp"
#include "prepare.hpp"
#include "vesica/compare/comparison.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/run/run.hpp"

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
  run::Options options = library_options(arguments.options, arguments.inputs.front());
  options.interrupt = &catch_signals();
  for (auto& [name, config, vesicle] : prepared.runs) {
    if (!arguments.options.is_quiet) std::cout << name << ":\n";
    run::Result result = run::run(config, vesicle, options);
    if (result.verdict.outcome.status == relax::RunStatus::interrupted) {
      std::cerr << "vesica-compare: interrupted in the run " << name
                << ", which is saved; nothing was compared\n";
      return relax::exit_status(result.verdict.outcome);
    }
    results.push_back({name, config.output.directory, std::move(vesicle.model),
                       std::move(result.state), std::move(result.verdict),
                       io::read_history(config.output.directory)});
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
  return run_program("vesica-compare", [&] {
    const ParsedCommandLine command_line = parse_command_line(argc, argv);
    if (!command_line.arguments) return command_line.status;
    const Arguments& arguments = *command_line.arguments;
    return arguments.inputs.size() == 1 ? compare_methods(arguments) : compare_folders(arguments);
  });
}
