#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/program.hpp"

namespace vesica {

/// A run to be compared: its name, and what it sets in the case, "table.key=value".
struct Column {
  std::string name;
  std::vector<std::string> overrides;
};

/// The command line of vesica-compare.
struct Arguments {
  std::vector<std::string> inputs;  ///< a case file, or two folders of finished runs
  RunOptions options;
  bool compares_both_schemes = false;
  std::vector<std::string> flow_overrides;
  std::vector<std::string> minimize_overrides;
  std::vector<std::string> weak_form_overrides;
};

/// Arguments, or the exit status when there is nothing to do (help, version, wrong use).
struct ParsedCommandLine {
  std::optional<Arguments> arguments;
  int status = 0;
};

[[nodiscard]] ParsedCommandLine parse_command_line(int argc, char** argv);

/// The runs of a case: flow and minimize; with both schemes the flow is the variational one, and
/// the weak form is the third. What the user sets for one run comes after what makes it that run.
[[nodiscard]] std::vector<Column> columns(const Arguments& arguments);

}  // namespace vesica
