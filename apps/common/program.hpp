#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vesica/run/run.hpp"

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

/// What the command line says of a run of `case_file`; progress goes to the standard output.
[[nodiscard]] run::Options library_options(const RunOptions& options, const std::string& case_file);

/// Catches SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE and SIGXFSZ, unless they are ignored: the
/// first one is stored in the result, a second SIGINT or SIGTERM ends the program at once.
const std::atomic<int>& catch_signals();

/// The body of main(): the exit status that `run` returns. An exception is printed to the standard
/// error output behind the program's name and becomes 2 (ConfigError), 4 (IoError) or 3 (any
/// other). Those signals are blocked before main() begins and are let through to this thread.
[[nodiscard]] int run_program(std::string_view program, const std::function<int()>& run);

/// Prints one line each to the standard error output.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace vesica
