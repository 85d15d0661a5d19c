#include "run_options.hpp"

#include "vesica/core/version.hpp"

namespace vesica {

void add_run_options(CLI::App& app, RunOptions& options) {
  app.set_version_flag("--version", std::string(version()));
  app.add_option("--set", options.overrides,
                 "set an option of the case file, as in --set solver.rtol=1e-4; may be repeated")
      ->type_name("table.key=value")
      ->allow_extra_args(false);
  app.add_option("--out", options.directory, "folder of the results: output.directory")
      ->type_name("DIR");
  app.add_flag("--overwrite", options.overwrites, "replace a run that is in the folder");
  app.add_flag("--quiet", options.is_quiet, "print nothing but warnings and errors");
  app.footer(
      "Exit status: 0 converged; 1 stopped before convergence; 2 bad input;\n"
      "3 numerical failure; 4 files could not be read or written; 130 or 143 interrupted.");
}

}  // namespace vesica
