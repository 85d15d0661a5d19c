#include "vesica/io/trajectory_writer.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "io/trajectory_file.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view part_name = "trajectory.part.h5";
constexpr std::string_view final_name = "trajectory.h5";
constexpr std::string_view part_xdmf_name = "trajectory.part.xdmf";
constexpr std::string_view final_xdmf_name = "trajectory.xdmf";

}  // namespace

class TrajectoryWriter::Writer {
 public:
  Writer(fs::path folder, const config::RunConfig& config, const setup::Case& vesicle)
      : folder_(std::move(folder)),
        lock_(folder_),
        output_(config.output),
        file_(folder_ / part_name, config, vesicle) {}

  void observe(const relax::StepView& view) {
    file_.add_row(view);
    last_positions_ = view.state.values.positions;
    const long step = view.report.counts.steps;
    if (file_.frames().empty() || step % output_.every_steps == 0) add_frame(view);
  }

  void mesh_changed(const relax::StepView& view, const relax::MeshChange& change) {
    file_.add_mesh_change(change);
    last_positions_ = view.state.values.positions;
    add_frame(view);
  }

  void happened(const relax::Event& event) { file_.add_event(event); }

  void finish(const relax::StepView& view, const relax::Outcome& outcome) {
    const mesh::Positions& positions = view.state.values.positions;
    const bool was_moved =
        last_positions_.rows() != positions.rows() || last_positions_ != positions;
    if (was_moved) file_.add_row(view);
    if (was_moved || view.report.counts.steps != last_frame_step_) file_.add_frame(view);
    file_.add_outcome(view, outcome);
    file_.flush();
    file_.close();
    publish();
  }

 private:
  void add_frame(const relax::StepView& view) {
    file_.add_frame(view);
    file_.flush();
    if (output_.paraview)
      write_text_file(folder_ / part_xdmf_name, xdmf_text(part_name, file_.frames()));
    last_frame_step_ = view.report.counts.steps;
  }

  /// Puts the finished files in place of those of an older run.
  void publish() const {
    std::error_code error;
    fs::rename(folder_ / part_name, folder_ / final_name, error);
    if (error) {
      throw IoError(fmt::format("{}: cannot be written ({})", (folder_ / final_name).string(),
                                error.message()));
    }
    if (output_.paraview) {
      write_text_file(folder_ / final_xdmf_name, xdmf_text(final_name, file_.frames()));
    } else {
      fs::remove(folder_ / final_xdmf_name, error);
    }
    fs::remove(folder_ / part_xdmf_name, error);
  }

  fs::path folder_;
  FolderLock lock_;
  config::OutputOptions output_;
  TrajectoryFile file_;
  mesh::Positions last_positions_;
  long last_frame_step_ = -1;
};

TrajectoryWriter::TrajectoryWriter(fs::path folder, const config::RunConfig& config,
                                   const setup::Case& vesicle)
    : writer_(std::make_unique<Writer>(std::move(folder), config, vesicle)) {}

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
  last->finish(view, outcome);
}

}  // namespace vesica::io
