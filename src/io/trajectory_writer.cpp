#include "vesica/io/trajectory_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "io/record/durable_files.hpp"
#include "io/record/file_names.hpp"
#include "io/record/publication.hpp"
#include "io/record/trajectory_file.hpp"
#include "io/record/xdmf_file.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/verdict_files.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// 128 random bits.
std::string new_run() {
  std::random_device random;
  std::string digits;
  for (int i = 0; i < 4; ++i) digits += fmt::format("{:08x}", random());
  return digits;
}

/// What a run that goes on keeps of its record. Nothing when the record is damaged at a place that
/// the run would have to go on with. Another run may have gone on since the case was made.
std::optional<RecordEnd> find_end(const fs::path& folder, const fs::path& record,
                                  const setup::Resumption& resumed) {
  if (resumed.is_checkpoint) return std::nullopt;
  try {
    const RecordReader reader(record);
    if (reader.run() == resumed.run && reader.num_frames() == resumed.num_frames)
      return reader.end(resumed.frame + 1);
  } catch (const IoError&) {
    return std::nullopt;
  }
  throw ConfigError(fmt::format("{}: another run has written to it meanwhile", folder.string()));
}

/// Makes the record in the folder, which is locked, a part again, for the run that goes on; a
/// damaged one is set aside, and a new one begins.
std::optional<RecordEnd> reopened(const fs::path& folder, const setup::Resumption& resumed) {
  const fs::path part = folder / file_names::part;
  std::error_code ignored;
  const fs::path record = fs::exists(part, ignored) ? part : folder / file_names::record;
  const std::optional<RecordEnd> end = find_end(folder, record, resumed);
  for (const char* name : {file_names::verdict, file_names::xdmf}) remove_file(folder / name);
  if (!end && fs::exists(record, ignored)) rename_file(record, folder / file_names::damaged);
  if (end && record != part) rename_file(record, part);
  synchronise_folder(folder);
  return end;
}

std::optional<RecordEnd> prepared(const fs::path& folder, const setup::Case& vesicle,
                                  bool replaces) {
  if (!replaces) check_holds_no_run(folder);
  if (!goes_on_in(folder, vesicle)) return std::nullopt;
  return reopened(folder, *vesicle.resumed);
}

TrajectoryFile make_file(const fs::path& folder, const std::optional<RecordEnd>& end,
                         const std::string& run, const config::RunConfig& config,
                         const setup::Case& vesicle) {
  if (end) return {folder / file_names::part, *end, config, vesicle};
  return {folder / file_names::new_part, run, config, vesicle};
}

}  // namespace

class TrajectoryWriter::Writer {
 public:
  Writer(fs::path folder, const config::RunConfig& config, const setup::Case& vesicle,
         bool replaces)
      : folder_(std::move(folder)),
        lock_(folder_),
        config_(config),
        model_(vesicle.model),
        origin_(vesicle.origin),
        warnings_(vesicle.warnings),
        end_(prepared(folder_, vesicle, replaces)),
        run_(end_ ? vesicle.resumed->run : new_run()),
        file_(make_file(folder_, end_, run_, config, vesicle)) {
    if (!end_) return;
    last_positions_ = vesicle.start.values.positions;
    last_frame_step_ = 0;
  }

  void observe(const relax::StepView& view) {
    last_positions_ = view.state.values.positions;
    const long step = view.report.counts.steps;
    if (end_ && step == 0) return;  // the last frame of the record
    file_.add_row(whole(view).view());
    if (file_.frames().empty() || step % config_.output.every_steps == 0) add_frame(view);
  }

  void mesh_changed(const relax::StepView& view, const relax::MeshChange& change) {
    relax::MeshChange counted = change;
    counted.step += earlier_steps();
    file_.add_mesh_change(counted);
    last_positions_ = view.state.values.positions;
    add_frame(view);
  }

  void happened(const relax::Event& event) {
    relax::Event counted = event;
    counted.step += earlier_steps();
    file_.add_event(counted);
  }

  relax::Verdict finish(const relax::StepView& view, const relax::Outcome& outcome) {
    const mesh::Positions& positions = view.state.values.positions;
    const bool was_moved =
        last_positions_.rows() != positions.rows() || last_positions_ != positions;
    if (was_moved) file_.add_row(whole(view).view());
    if (was_moved || view.report.counts.steps != last_frame_step_)
      file_.add_frame(whole(view).view());
    relax::Verdict verdict =
        relax::make_verdict(whole(outcome), config_.solver, model_, view.state);
    verdict.run = run_;
    verdict.warnings = warnings_;
    file_.add_outcome(view, verdict.outcome, to_json(verdict));
    commit();
    file_.close();
    publish(folder_);
    write_checkpoint(view);
    return verdict;
  }

 private:
  /// A view with the counts and seconds of all parts of the run.
  struct WholeView {
    const relax::StepView& part;
    solve::StepReport report;
    [[nodiscard]] relax::StepView view() const { return {part.state, report, part.diagnostics}; }
  };
  [[nodiscard]] WholeView whole(const relax::StepView& view) const {
    WholeView result{view, view.report};
    if (!end_) return result;
    result.report.counts += end_->outcome.report.counts;
    result.report.seconds += end_->outcome.report.seconds;
    return result;
  }

  /// The outcome of all parts of the run.
  [[nodiscard]] relax::Outcome whole(const relax::Outcome& part) const {
    if (!end_) return part;
    relax::Outcome result = part;
    const relax::Outcome& earlier = end_->outcome;
    result.report.counts += earlier.report.counts;
    result.report.seconds += earlier.report.seconds;
    for (relax::Event& event : result.events) event.step += earlier_steps();
    for (relax::MeshChange& change : result.mesh_changes) change.step += earlier_steps();
    result.events.insert(result.events.begin(), earlier.events.begin(), earlier.events.end());
    result.mesh_changes.insert(result.mesh_changes.begin(), earlier.mesh_changes.begin(),
                               earlier.mesh_changes.end());
    if (end_->num_rows == 0) return result;
    result.initial_quality = earlier.initial_quality;
    result.smallest_quality = std::min(part.smallest_quality, earlier.smallest_quality);
    return result;
  }

  [[nodiscard]] long earlier_steps() const { return end_ ? end_->outcome.report.counts.steps : 0; }

  void add_frame(const relax::StepView& view) {
    file_.add_frame(whole(view).view());
    commit();
    if (config_.output.paraview) announce();
    last_frame_step_ = view.report.counts.steps;
    if (Clock::now() >= next_checkpoint_) write_checkpoint(view);
  }

  void announce() {
    if (xdmf_) {
      xdmf_->add(file_.frames().back());
    } else {
      xdmf_.emplace(folder_ / file_names::part_xdmf, file_names::part, run_, file_.frames());
    }
  }

  /// The state alone, for the case that the record is damaged.
  void write_checkpoint(const relax::StepView& view) {
    const fs::path temporary = folder_ / file_names::new_checkpoint;
    {
      TrajectoryFile file(temporary, run_, config_, {model_, {}, origin_, {}});
      file.add_frame(whole(view).view());
      file.close();
    }
    remove_file(folder_ / file_names::new_checkpoint_journal);
    const fs::path checkpoint = folder_ / file_names::checkpoint;
    std::error_code ignored;
    if (fs::exists(checkpoint, ignored))
      rename_file(checkpoint, folder_ / file_names::previous_checkpoint);
    rename_file(temporary, checkpoint);
    synchronise_folder(folder_);
    next_checkpoint_ = Clock::now() + std::chrono::seconds(10);
  }

  /// A new record gets its name with its first frame, so that every record has one.
  void commit() {
    file_.flush();
    if (end_ || has_name_) return;
    for (const char* name : {file_names::journal, file_names::checkpoint,
                             file_names::previous_checkpoint})  // of an older run
      remove_file(folder_ / name);
    rename_file(folder_ / file_names::new_part, folder_ / file_names::part);
    file_.was_renamed(folder_ / file_names::part);
    synchronise_folder(folder_);
    has_name_ = true;
  }

  fs::path folder_;
  FolderLock lock_;
  config::RunConfig config_;
  model::Model model_;
  setup::Origin origin_;
  std::vector<std::string> warnings_;
  std::optional<RecordEnd> end_;  ///< of a run that goes on in its folder
  std::string run_;
  TrajectoryFile file_;
  std::optional<XdmfFile> xdmf_;  ///< from the first frame on
  bool has_name_ = false;
  mesh::Positions last_positions_;
  long last_frame_step_ = -1;
  Clock::time_point next_checkpoint_;  ///< the first one at once
};

TrajectoryWriter::TrajectoryWriter(fs::path folder, const config::RunConfig& config,
                                   const setup::Case& vesicle, bool replaces)
    : writer_(std::make_unique<Writer>(std::move(folder), config, vesicle, replaces)) {}

TrajectoryWriter::~TrajectoryWriter() = default;

/// After an error nothing more is written.
template <class Write>
void TrajectoryWriter::write(const Write& write) {
  if (!writer_) return;
  try {
    write(*writer_);
  } catch (...) {
    writer_.reset();
    throw;
  }
}

void TrajectoryWriter::observe(const relax::StepView& view) {
  write([&](Writer& writer) { writer.observe(view); });
}

void TrajectoryWriter::mesh_changed(const relax::StepView& view, const relax::MeshChange& change) {
  write([&](Writer& writer) { writer.mesh_changed(view, change); });
}

void TrajectoryWriter::happened(const relax::StepView&, const relax::Event& event) {
  write([&](Writer& writer) { writer.happened(event); });
}

void TrajectoryWriter::finish(const relax::StepView& view, const relax::Outcome& outcome) {
  if (!writer_) return;
  const std::unique_ptr<Writer> last = std::move(writer_);
  verdict_ = last->finish(view, outcome);
}

}  // namespace vesica::io
