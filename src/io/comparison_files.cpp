#include "vesica/io/comparison_files.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>

#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/measure/profile.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* script_name = "comparison.gp";

std::string profile_text(const problem::State& state, const measure::ProfilePlane& plane) {
  std::string text = "# loop,along,across,order_parameter\n";
  int number = 0;
  for (const measure::ProfileLoop& loop : measure::profile(state, plane)) {
    for (const measure::ProfilePoint& point : loop)
      text +=
          fmt::format("{},{},{},{}\n", number, point.along, point.across, point.order_parameter);
    text += "\n";  // gnuplot lifts the pen
    ++number;
  }
  return text;
}

std::string energy_text(const compare::EnergyHistory& history) {
  std::string text = "# step,seconds,energy\n";
  for (std::size_t i = 0; i < history.energy.size(); ++i)
    text += fmt::format("{},{},{}\n", history.step[i], history.seconds[i], history.energy[i]);
  return text;
}

/// The final state of a run as the first run is placed.
problem::State placed(const compare::Comparison& comparison, std::size_t run) {
  problem::State state = comparison.runs[run].state;
  if (run > 0) {
    const compare::RigidMotion& motion = comparison.differences[run - 1].shape.motion;
    state.values.positions = motion.of(state.values.positions);
  }
  return state;
}

/// File actions of posix_spawn that are released with it.
class FileActions {
 public:
  FileActions() { error_ = ::posix_spawn_file_actions_init(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ~FileActions() { (void)::posix_spawn_file_actions_destroy(&actions_); }

  void change_folder(const fs::path& folder) {
    if (error_ == 0) error_ = ::posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
  }
  [[nodiscard]] int error() const { return error_; }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
  int error_ = 0;
};

/// Runs `gnuplot comparison.gp` in the folder; why it could not, if so.
std::optional<std::string> run_gnuplot(const fs::path& folder) {
  FileActions actions;
  actions.change_folder(folder);
  std::string program = "gnuplot";
  std::string script = script_name;
  char* const arguments[] = {program.data(), script.data(), nullptr};
  pid_t process = 0;
  int error = actions.error();
  if (error == 0) {
    error = ::posix_spawnp(&process, "gnuplot", actions.get(), nullptr, arguments, ::environ);
  }
  if (error == ENOENT) return "gnuplot is not installed";
  if (error != 0)
    return fmt::format("gnuplot cannot be started ({})", std::generic_category().message(error));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return "gnuplot got lost";
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  return "gnuplot failed";
}

compare::ComparedRun named(std::string name, const std::filesystem::path& folder, FinishedRun run) {
  return {std::move(name),        folder,
          std::move(run.model),   std::move(run.state),
          std::move(run.verdict), std::move(run.history)};
}

}  // namespace

std::vector<compare::ComparedRun> read_runs(const std::filesystem::path& first,
                                            const std::filesystem::path& second) {
  FinishedRun a = read_run(first);
  FinishedRun b = read_run(second);
  const auto is_minimizer = [](const FinishedRun& run) { return run.verdict.method == "minimize"; };
  const bool are_of_two_kinds = is_minimizer(a) != is_minimizer(b);
  const bool is_a_minimizer = is_minimizer(a);
  const auto name = [&](bool is_minimizer_run, const char* otherwise) {
    return are_of_two_kinds ? (is_minimizer_run ? "minimize" : "flow") : otherwise;
  };
  std::vector<compare::ComparedRun> runs;
  runs.push_back(named(name(is_a_minimizer, "first"), first, std::move(a)));
  runs.push_back(named(name(!is_a_minimizer, "second"), second, std::move(b)));
  return runs;
}

void check_comparison_folder(const fs::path& folder, bool overwrite) {
  std::error_code ignored;
  if (overwrite || !fs::exists(folder / "comparison.json", ignored)) return;
  throw ConfigError(fmt::format(
      "{}: already holds a comparison; choose another output folder or give --overwrite",
      folder.string()));
}

void write_comparison(const fs::path& folder, const compare::Comparison& comparison) {
  const measure::ProfilePlane plane = measure::profile_plane(comparison.runs.front().state);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const compare::ComparedRun& run = comparison.runs[i];
    write_text_file(folder / fmt::format("profile_{}.csv", run.name),
                    profile_text(placed(comparison, i), plane));
    write_text_file(folder / fmt::format("energy_{}.csv", run.name), energy_text(run.history));
  }
  write_text_file(folder / script_name, plot_script(comparison));
  write_text_file(folder / "comparison.json", to_json(comparison));
}

void print_comparison_files(std::ostream& out, const compare::Comparison& comparison,
                            const fs::path& folder) {
  std::error_code ignored;
  const auto print = [&](const std::string& name, const char* meaning) {
    if (fs::exists(folder / name, ignored))
      out << fmt::format("  {}  {}\n", (folder / name).string(), meaning);
  };
  out << "files:\n";
  print("comparison.json", "what is above, for programs");
  print("profiles.png", "cuts through the long axis");
  print("energy.png", "energies against seconds");
  print(script_name, "the gnuplot script of the pictures");
  for (const compare::ComparedRun& run : comparison.runs) {
    print(fmt::format("profile_{}.csv", run.name), "a cut");
    print(fmt::format("energy_{}.csv", run.name), "energy after every step");
    print(run.name, "the run itself");
  }
  out << std::flush;
}

std::optional<std::string> draw_comparison(const fs::path& folder) {
  const std::optional<std::string> failure = run_gnuplot(folder);
  if (!failure) return std::nullopt;
  return fmt::format("no pictures: {}; once it works, draw them by: cd {} && gnuplot {}", *failure,
                     folder.string(), script_name);
}

}  // namespace vesica::io
