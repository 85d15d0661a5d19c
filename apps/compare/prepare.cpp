#include "prepare.hpp"

#include <algorithm>
#include <utility>

#include "common/program.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/run/run.hpp"

namespace vesica {

namespace {

/// Those of all runs, each once.
std::vector<std::string> warnings_of(const PreparedComparison& comparison) {
  std::vector<std::string> warnings;
  for (const auto& run : comparison.runs) {
    for (const std::string& warning : run.vesicle.warnings) {
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
        warnings.push_back(warning);
    }
  }
  return warnings;
}

}  // namespace

PreparedComparison prepare(const Arguments& arguments) {
  const std::string& case_file = arguments.inputs.front();
  const run::Options options = library_options(arguments.options, case_file);
  PreparedComparison result;
  for (const Column& column : columns(arguments)) {
    std::vector<std::string> overrides = arguments.options.overrides;
    overrides.insert(overrides.end(), column.overrides.begin(), column.overrides.end());
    config::RunConfig config = config::read_config(case_file, overrides);
    result.folder =
        arguments.options.directory.empty() ? config.output.directory : arguments.options.directory;
    config.output.directory = (result.folder / column.name).string();
    setup::Case vesicle = run::prepare(config, options);
    result.runs.push_back({column.name, std::move(config), std::move(vesicle)});
  }
  io::check_comparison_folder(result.folder, arguments.options.overwrites);
  print_warnings(warnings_of(result));
  return result;
}

}  // namespace vesica
