#include "program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <iostream>

#include "vesica/core/error.hpp"
#include "vesica/core/version.hpp"
#include "vesica/io/run_reader.hpp"

namespace vesica {
namespace {

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may store it");

/// Those that end a run after its present step.
constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE, SIGXFSZ};

/// Blocks them in the calling thread, or lets them through.
void mask_signals(int how) {
  sigset_t signals{};
  sigemptyset(&signals);
  for (const int signal : ending_signals) sigaddset(&signals, signal);
  pthread_sigmask(how, &signals, nullptr);
}

/// Runs before the shared libraries are initialised: threads that they start there (OpenBLAS does)
/// inherit the mask and never get a signal that the library holds back from the main thread while
/// METIS orders.
using Initialiser = void (*)();
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser before_libraries = [] {
  mask_signals(SIG_BLOCK);
};

/// Where standard input, output or error is closed, a file that is opened would take its place and
/// get what is printed.
void open_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", O_RDWR);
}

}  // namespace

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
      "3 numerical failure; 4 files could not be read or written; 128 + signal interrupted.");
}

run::Options library_options(const RunOptions& options, const std::string& case_file) {
  run::Options result;
  result.overwrites = options.overwrites;
  result.case_file = case_file;
  if (!options.is_quiet) result.progress = &std::cout;
  const bool is_terminal = ::isatty(STDOUT_FILENO) != 0;
  if (is_terminal) result.progress_style = io::ProgressStyle::rewriting;
  return result;
}

const std::atomic<int>& catch_signals() {
  for (const int signal : ending_signals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;  // nohup, for example
    struct sigaction action {};
    action.sa_handler = [](int number) { received_signal.store(number); };
    const bool is_of_people = signal == SIGINT || signal == SIGTERM;
    if (is_of_people) action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
  return received_signal;
}

int run_program(std::string_view program, const std::function<int()>& run) {
  const auto fail = [&](const std::exception& error, int status) {
    std::cerr << program << ": " << error.what() << '\n';
    return status;
  };
  open_standard_descriptors();
  io::leave_hdf5_without_cleanup();
  mask_signals(SIG_UNBLOCK);
  try {
    return run();
  } catch (const ConfigError& error) {
    return fail(error, 2);
  } catch (const IoError& error) {
    return fail(error, 4);
  } catch (const std::exception& error) {
    return fail(error, 3);
  }
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
}

}  // namespace vesica
