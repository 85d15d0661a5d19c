#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "vesica/core/version.hpp"

namespace vesica {
namespace {

constexpr int bad_input = 2;

void add_options(CLI::App& app, Arguments& arguments, std::string& rtol, bool& wants_template) {
  app.set_version_flag("--version", std::string(version()));
  app.add_option("case", arguments.case_file, "case file")->type_name("CASE.toml");
  app.add_option("--set", arguments.overrides,
                 "set an option of the case file, as in --set solver.rtol=1e-4; may be repeated")
      ->type_name("table.key=value")
      ->allow_extra_args(false);
  app.add_option("--rtol", rtol, "relative tolerance of the time integration: solver.rtol")
      ->type_name("X");
  app.add_option("--out", arguments.directory, "folder of the run: output.directory")
      ->type_name("DIR");
  app.add_flag("--overwrite", arguments.overwrites, "replace a run that is in the folder");
  app.add_flag("--quiet", arguments.is_quiet, "print nothing but warnings and errors");
  app.add_flag("--template", wants_template,
               "print a case file with every option, its default and meaning");
  app.footer(
      "Exit status: 0 converged; 1 stopped by a limit before convergence; 2 bad input;\n"
      "3 numerical failure; 4 files could not be read or written; 130 or 143 interrupted.");
}

}  // namespace

ParsedCommandLine parse_command_line(int argc, char** argv) {
  CLI::App app("Relaxes a lipid vesicle to an equilibrium shape.", "vesica-relax");
  Arguments arguments;
  std::string rtol;
  bool wants_template = false;
  add_options(app, arguments, rtol, wants_template);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? 0 : bad_input};
  }
  if (wants_template) {
    io::write_template(std::cout);
    return {};
  }
  if (arguments.case_file.empty()) {
    std::cerr << "vesica-relax: a case file is needed; --help tells more, --template prints one\n";
    return {std::nullopt, bad_input};
  }
  if (!rtol.empty()) arguments.overrides.push_back("solver.rtol=" + rtol);
  return {arguments, 0};
}

io::RunConfig read_config(const Arguments& arguments) {
  io::RunConfig config = io::read_config(arguments.case_file, arguments.overrides);
  if (!arguments.directory.empty()) config.output.directory = arguments.directory;
  return config;
}

}  // namespace vesica
