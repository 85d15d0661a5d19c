#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vesica {

/// What the command lines of all programs that run a case share.
struct RunOptions {
  std::vector<std::string> overrides;  ///< "table.key=value"
  std::string directory;               ///< empty: that of the case file
  bool overwrites = false;
  bool is_quiet = false;
};

/// Adds --version, --set, --out, --overwrite and --quiet, and the exit statuses as footer.
/// `options` must outlive `app`.
void add_run_options(CLI::App& app, RunOptions& options);

}  // namespace vesica
