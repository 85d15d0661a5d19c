#include "prepare.hpp"

#include <iostream>
#include <utility>

#include "common/run_case.hpp"
#include "vesica/io/comparison_files.hpp"

namespace vesica {

PreparedComparison prepare(const Arguments& arguments) {
  const std::string& case_file = arguments.inputs.front();
  PreparedComparison result;
  for (const Column& column : columns(arguments)) {
    std::vector<std::string> overrides = arguments.options.overrides;
    overrides.insert(overrides.end(), column.overrides.begin(), column.overrides.end());
    config::RunConfig config = config::read_config(case_file, overrides);
    result.folder =
        arguments.options.directory.empty() ? config.output.directory : arguments.options.directory;
    config.output.directory = (result.folder / column.name).string();
    setup::Case vesicle = config::with_places(config, [&] {
      check_run(config, case_file, arguments.options.overwrites);
      return setup::make_case(config);
    });
    result.runs.push_back({column.name, std::move(config), std::move(vesicle)});
  }
  io::check_comparison_folder(result.folder, arguments.options.overwrites);
  for (const std::string& warning : result.runs.front().vesicle.warnings)
    std::cerr << "warning: " << warning << '\n';
  return result;
}

}  // namespace vesica
