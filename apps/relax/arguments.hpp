#pragma once

#include <optional>
#include <string>

#include "common/program.hpp"
#include "vesica/config/config.hpp"

namespace vesica {

/// The command line of vesica-relax.
struct Arguments {
  std::string case_file;  ///< empty: that of the run to go on with
  RunOptions options;
  std::string start_file;  ///< the start is written here, and nothing runs; empty: a run
  std::string resumed;     ///< folder of the run to go on with; empty: none
};

/// Arguments of a run, or the exit status when there is nothing to run (help, version, template,
/// wrong use).
struct ParsedCommandLine {
  std::optional<Arguments> arguments;
  int status = 0;
};

[[nodiscard]] ParsedCommandLine parse_command_line(int argc, char** argv);

/// The case file, or the case of the run that is resumed, with what the command line sets. Throws
/// ConfigError and IoError.
[[nodiscard]] config::RunConfig read_config(const Arguments& arguments);

}  // namespace vesica
