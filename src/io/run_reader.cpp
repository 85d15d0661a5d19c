#include "vesica/io/run_reader.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "io/record/config_changes.hpp"
#include "io/record/file_names.hpp"
#include "io/record/publication.hpp"
#include "io/record/record_reader.hpp"
#include "io/result_json.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

void check_has_ended(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw IoError(fmt::format("{}: no such folder", folder.string()));
  for (const char* name : {file_names::record, file_names::configuration, file_names::verdict}) {
    if (fs::is_regular_file(folder / name, ignored)) continue;
    const bool can_go_on = fs::exists(folder / file_names::part, ignored) ||
                           fs::exists(folder / file_names::record, ignored);
    throw IoError(fmt::format("{}: holds no finished run ({} is missing{})", folder.string(), name,
                              can_go_on ? "; the run goes on or broke off: vesica-relax --resume "
                                          "completes it"
                                        : ""));
  }
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The record in a folder: that of a run that broke off or, where there is none, of one that has
/// ended. Throws ConfigError when a run is writing to it.
fs::path record_in(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw IoError(fmt::format("{}: no such folder", folder.string()));
  const FolderLock nobody_writes(folder);
  return folder / (is_there(folder / file_names::part) ? file_names::part : file_names::record);
}

/// From where a run can go on: the record or, where that is damaged or gone, a checkpoint.
struct Source {
  fs::path path;
  bool is_checkpoint = false;
  std::string warning;
};

Source source_in(const fs::path& folder) {
  Source source{record_in(folder), false, {}};
  if (!is_there(source.path) && !is_there(folder / file_names::checkpoint) &&
      !is_there(folder / file_names::previous_checkpoint)) {
    throw IoError(
        fmt::format("{}: holds no run ({} is missing)", folder.string(), file_names::record));
  }
  for (const fs::path& path :
       {source.path, folder / file_names::checkpoint, folder / file_names::previous_checkpoint}) {
    try {
      const RecordReader record(path);
      (void)record.configuration();
      (void)record.origin();
      const double time = record.last_good().state.time;
      if (source.warning.empty()) return source;
      return {path, true,
              fmt::format("{}; the run goes on from {} at t = {:g}", source.warning,
                          path.filename().string(), time)};
    } catch (const IoError& error) {
      if (source.warning.empty()) source.warning = error.what();
    }
  }
  throw IoError(source.warning);
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw IoError(fmt::format("{}: cannot be read ({})", path.string(),
                              std::generic_category().message(errno)));
  }
  return std::move(text).str();
}

/// Its values are checked one by one; then it must be the verdict that the record holds.
relax::Verdict checked_verdict(const fs::path& folder, const RecordReader& record) {
  const fs::path path = folder / file_names::verdict;
  const std::string text = text_of(path);
  relax::Verdict verdict = read_verdict(path, text);
  if (verdict.run.value_or("") != record.run()) {
    throw IoError(fmt::format("{}: belongs to the run {}, {} to the run {}", path.string(),
                              verdict.run.value_or("without a number"), file_names::record,
                              record.run()));
  }
  if (record.verdict().value_or(text) != text) {
    throw IoError(fmt::format("{}: was changed: it is not the verdict that {} holds", path.string(),
                              file_names::record));
  }
  return verdict;
}

config::RunConfig checked_config(const fs::path& folder, const RecordReader& record) {
  const fs::path path = folder / file_names::configuration;
  const std::string text = text_of(path);
  const std::string run = record.run();
  if (!run.empty() && text.starts_with("# run ") && !text.starts_with(first_line(run))) {
    throw IoError(fmt::format("{}: belongs to another run than {}, {}", path.string(),
                              file_names::record, run));
  }
  return config::read_config_text(text, path.string(), {});
}

/// Refuses what a resumed run cannot take, names what else has changed.
std::vector<std::string> warnings_of(const std::vector<ConfigChange>& changes) {
  std::vector<std::string> warnings;
  for (const auto& [key, before, after] : changes) {
    if (key.starts_with("shape.") || key.starts_with("phase.")) {
      throw ConfigError(fmt::format(
          "{} = {}: a resumed run goes on from its last state, which began with {}: leave it so",
          key, after.empty() ? "none" : after, before.empty() ? "none" : before));
    }
    warnings.push_back(fmt::format("the run goes on with {} = {} instead of {}", key,
                                   after.empty() ? "none" : after,
                                   before.empty() ? "none" : before));
  }
  return warnings;
}

/// The rates of the last state hold as long as only limits and files are other ones.
bool keep_the_equations(const std::vector<ConfigChange>& changes) {
  return std::all_of(changes.begin(), changes.end(), [](const ConfigChange& change) {
    return change.key.starts_with("stop.") || change.key.starts_with("output.");
  });
}

bool has_converged(const RecordReader& record, const fs::path& path) {
  const std::optional<std::string> text = record.verdict();
  return text && read_verdict(path, *text).outcome.status == relax::RunStatus::converged;
}

config::RunConfig config_of(const RecordReader& record, const fs::path& path,
                            std::span<const std::string> overrides) {
  return config::read_config_text(record.configuration(), path.string() + ":/configuration/toml",
                                  overrides);
}

/// Times of a schedule that lie before the run goes on were skipped.
std::vector<std::string> warnings_of_past(const setup::Case& vesicle,
                                          const std::vector<ConfigChange>& changes) {
  std::vector<std::string> warnings;
  for (const auto& [table, name, schedule] : model::schedules_of(vesicle.model)) {
    const std::string key = fmt::format("{}.{}", table, name);
    const bool is_new = std::any_of(changes.begin(), changes.end(),
                                    [&](const auto& change) { return change.key == key; });
    if (!is_new || schedule.is_constant()) continue;
    const double now = vesicle.start.time;
    const double first = schedule.next_kink(-std::numeric_limits<double>::infinity());
    if (first >= now) continue;
    warnings.push_back(fmt::format(
        "{} = {}: begins before t = {:g}, where the run goes on: its value is {:g} from there", key,
        text_of(schedule), now, schedule.value(now)));
  }
  return warnings;
}

}  // namespace

void leave_hdf5_without_cleanup() { (void)H5dont_atexit(); }

compare::EnergyHistory read_history(const fs::path& folder) {
  return RecordReader(folder / file_names::record).history();
}

Frame read_frame(const fs::path& folder, std::optional<std::size_t> index) {
  const bool goes_on =
      !is_there(folder / file_names::record) && is_there(folder / file_names::part);
  const RecordReader record(folder / (goes_on ? file_names::part : file_names::record));
  const std::size_t count = record.num_frames();
  if (index && *index >= count) {
    throw ConfigError(
        fmt::format("{}: frame {}: must be in [0, {})", folder.string(), *index, count));
  }
  const std::size_t chosen = index.value_or(count - 1);
  return {record.frame(chosen).state, chosen, count};
}

FinishedRun read_run(const fs::path& folder) {
  check_has_ended(folder);
  FinishedRun run;
  const RecordReader record(folder / file_names::record);
  run.config = checked_config(folder, record);
  run.verdict = checked_verdict(folder, record);
  run.state = record.last().state;
  const fs::path path = folder / file_names::record;
  if (run.state.is_two_phase() != run.config.phase.has_value()) {
    throw IoError(fmt::format("{}: the last frame has {} order_parameter, {} has {} table [phase]",
                              path.string(), run.config.phase ? "no" : "an",
                              file_names::configuration, run.config.phase ? "a" : "no"));
  }
  run.model = setup::case_of(run.config, run.state, record.origin()).model;
  if (run.verdict.num_nodes != run.state.triangulation->num_nodes()) {
    throw IoError(
        fmt::format("{}: /frames and verdict.json differ in the number of nodes", path.string()));
  }
  if (run.verdict.outcome.status == relax::RunStatus::interrupted)
    run.verdict.outcome.signal = record.signal();
  run.history = record.history();
  return run;
}

setup::Case resumed_case(const config::RunConfig& config, const fs::path& folder) {
  const Source source = source_in(folder);
  const RecordReader record(source.path);
  RecordFrame frame = record.last_good();
  if (frame.state.is_two_phase() != config.phase.has_value()) {
    throw ConfigError(fmt::format("{}: the run has {} phase field, the case has {}",
                                  folder.string(), config.phase ? "no" : "a",
                                  config.phase ? "one" : "none"));
  }
  const std::vector<ConfigChange> changes =
      changes_between(config_of(record, source.path, {}), config);
  std::vector<std::string> warnings = warnings_of(changes);
  setup::Case vesicle = setup::case_of(config, std::move(frame.state), record.origin());
  for (std::string& past : warnings_of_past(vesicle, changes)) warnings.push_back(std::move(past));
  for (const std::string& damage : {source.warning, frame.warning})
    if (!damage.empty()) warnings.push_back(damage);
  vesicle.warnings.insert(vesicle.warnings.end(), warnings.begin(), warnings.end());
  const bool is_in_motion = keep_the_equations(changes) && !has_converged(record, source.path);
  const double step_size = is_in_motion ? frame.step_size : 0;
  vesicle.resumed = setup::Resumption{folder,      record.run(), record.num_frames(),
                                      frame.index, step_size,    source.is_checkpoint};
  return vesicle;
}

config::RunConfig recorded_config(const fs::path& folder, std::span<const std::string> overrides) {
  const fs::path path = source_in(folder).path;
  config::RunConfig config = config_of(RecordReader(path), path, overrides);
  config.output.directory = folder.string();
  return config;
}

std::optional<relax::Verdict> find_conclusion(const config::RunConfig& config,
                                              const fs::path& folder) {
  const fs::path path = source_in(folder).path;
  std::optional<relax::Verdict> verdict;
  {
    const RecordReader record(path);
    const std::optional<std::string> text = record.verdict();
    if (!text) return std::nullopt;
    verdict = read_verdict(path, *text);
    const bool is_final =
        verdict->outcome.status == relax::RunStatus::converged &&
        changes_between(config_of(record, path, {}), config::resolved(config)).empty();
    if (!is_final) return std::nullopt;
  }
  const FolderLock lock(folder);
  if (is_unpublished(folder)) publish(folder);
  return verdict;
}

}  // namespace vesica::io
