#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "vesica/io/run_reader.hpp"

namespace vesica {
namespace {

constexpr int bad_input = 2;

void add_options(CLI::App& app, Arguments& arguments, std::string& rtol, bool& wants_template) {
  add_run_options(app, arguments.options);
  app.add_option("case", arguments.case_file, "case file")->type_name("CASE.toml");
  app.add_option("--resume", arguments.resumed,
                 "go on with the run in this folder, from its last state; without a case file with "
                 "its own case, without --out in its own folder")
      ->type_name("DIR");
  app.add_option("--write-start", arguments.start_file,
                 "write the start as .vtu, .ply or .obj and run nothing")
      ->type_name("FILE");
  app.add_option("--rtol", rtol, "relative tolerance of the time integration: solver.rtol")
      ->type_name("X");
  app.add_flag("--template", wants_template,
               "print a case file with every option, its default and meaning");
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
    config::write_template(std::cout);
    return {};
  }
  if (arguments.case_file.empty() && arguments.resumed.empty()) {
    std::cerr << "vesica-relax: a case file is needed; --help tells more, --template prints one\n";
    return {std::nullopt, bad_input};
  }
  if (!rtol.empty()) arguments.options.overrides.push_back("solver.rtol=" + rtol);
  return {arguments, 0};
}

config::RunConfig read_config(const Arguments& arguments) {
  const std::vector<std::string>& overrides = arguments.options.overrides;
  config::RunConfig config = arguments.case_file.empty()
                                 ? io::recorded_config(arguments.resumed, overrides)
                                 : config::read_config(arguments.case_file, overrides);
  if (!arguments.options.directory.empty()) config.output.directory = arguments.options.directory;
  return config;
}

}  // namespace vesica
