#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace vesica {
namespace {

constexpr int bad_input = 2;

void add_options(CLI::App& app, Arguments& arguments, std::string& scheme) {
  add_run_options(app, arguments.options);
  app.add_option("input", arguments.inputs, "a case file, or the folders of two finished runs")
      ->type_name("CASE.toml | RUN_A RUN_B");
  app.add_option("--scheme", scheme,
                 "both: the variational flow, the minimiser and the weak form side by side")
      ->check(CLI::IsMember({"both"}));
  const auto add_overrides = [&app](const std::string& name, std::vector<std::string>& target) {
    app.add_option("--set-" + name, target, "like --set, for the run " + name + " alone")
        ->type_name("table.key=value")
        ->allow_extra_args(false);
  };
  add_overrides("flow", arguments.flow_overrides);
  add_overrides("minimize", arguments.minimize_overrides);
  add_overrides("weak-form", arguments.weak_form_overrides);
}

void append(Column& column, const std::vector<std::string>& overrides) {
  column.overrides.insert(column.overrides.end(), overrides.begin(), overrides.end());
}

}  // namespace

ParsedCommandLine parse_command_line(int argc, char** argv) {
  CLI::App app(
      "Relaxes a vesicle by the gradient flow and by minimisation, from the same start, and\n"
      "compares what they find; or compares two finished runs, which are only written about\n"
      "when --out is given.",
      "vesica-compare");
  Arguments arguments;
  std::string scheme;
  add_options(app, arguments, scheme);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? 0 : bad_input};
  }
  if (arguments.inputs.empty() || arguments.inputs.size() > 2) {
    std::cerr << "vesica-compare: a case file or two run folders are needed; --help tells more\n";
    return {std::nullopt, bad_input};
  }
  arguments.compares_both_schemes = scheme == "both";
  return {arguments, 0};
}

std::vector<Column> columns(const Arguments& arguments) {
  const bool both = arguments.compares_both_schemes;
  std::vector<Column> result{{"flow", {"solver.method=ida"}},
                             {"minimize", {"solver.method=minimize"}}};
  if (both) result[0].overrides.emplace_back("solver.scheme=variational");
  append(result[0], arguments.flow_overrides);
  append(result[1], arguments.minimize_overrides);
  if (both) {
    result.push_back({"weak_form", {"solver.method=ida", "solver.scheme=paper"}});
    append(result[2], arguments.weak_form_overrides);
  }
  return result;
}

}  // namespace vesica
