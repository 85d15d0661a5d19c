#include <iostream>

#include "arguments.hpp"
#include "common/guarded.hpp"
#include "common/run_case.hpp"
#include "common/signals.hpp"
#include "vesica/config/config.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/io/verdict_files.hpp"
#include "vesica/relax/interrupt_controller.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/setup/case.hpp"

namespace vesica {
namespace {

int run(const config::RunConfig& config, const Arguments& arguments) {
  check_run(config, arguments.case_file, arguments.options.overwrites);
  const setup::Case vesicle = arguments.resumed.empty()
                                  ? setup::make_case(config)
                                  : io::resumed_case(config, arguments.resumed);
  for (const std::string& warning : vesicle.warnings) std::cerr << "warning: " << warning << '\n';
  relax::InterruptController interrupt(catch_signals());
  const relax::Verdict verdict =
      run_case(config, vesicle, interrupt, arguments.options.is_quiet).verdict;
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
  admit_signals();
  return guarded("vesica-relax", [&] {
    const ParsedCommandLine command_line = parse_command_line(argc, argv);
    if (!command_line.arguments) return command_line.status;
    const config::RunConfig config = read_config(*command_line.arguments);
    return config::with_places(config, [&] { return run(config, *command_line.arguments); });
  });
}
