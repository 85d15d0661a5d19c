#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/writable_file.hpp"
#include "io/record/record_reader.hpp"
#include "io/record/time_series.hpp"
#include "io/record/xdmf.hpp"
#include "vesica/config/config.hpp"
#include "vesica/model/model.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// The groups of `trajectory.h5` (docs/output.md) and how they grow.
class TrajectoryFile {
 public:
  /// Makes the file with `/configuration`, `/origin` and `/versions`; all files of a run share the
  /// text `run`.
  TrajectoryFile(const std::filesystem::path& path, const std::string& run,
                 const config::RunConfig& config, const setup::Case& vesicle);
  /// Opens the file of a run that goes on behind `end`.
  TrajectoryFile(const std::filesystem::path& path, const RecordEnd& end,
                 const config::RunConfig& config, const setup::Case& vesicle);

  /// Kept until the next flush.
  void add_row(const relax::StepView& view);
  /// A frame, and its mesh when the connectivity is new.
  void add_frame(const relax::StepView& view);
  /// What the next frame's mesh is there for: attributes of its mesh group.
  void add_mesh_change(const relax::MeshChange& change) { next_change_ = change; }
  /// Kept until the next flush.
  void add_event(const relax::Event& event) { events_.push_back(event); }
  void add_outcome(const relax::StepView& view, const relax::Outcome& outcome,
                   const std::string& verdict);
  /// Rows, frames and events are committed: the disk has them.
  void flush();
  void was_renamed(const std::filesystem::path& path) { file_.was_renamed(path); }
  void close() { file_.close(); }
  [[nodiscard]] const std::vector<XdmfFrame>& frames() const { return frames_; }

 private:
  void cut_behind(const RecordEnd& end);
  void write_domains(const measure::Diagnostics& diagnostics);
  void write_mesh(std::shared_ptr<const mesh::Triangulation> triangulation);

  hdf5::WritableFile file_;
  model::Model model_;
  std::vector<std::vector<Number>> rows_;
  std::vector<relax::Event> events_;
  std::size_t num_written_events_ = 0;
  std::vector<XdmfFrame> frames_;
  std::size_t num_meshes_ = 0;
  std::shared_ptr<const mesh::Triangulation> last_triangulation_;
  std::optional<relax::MeshChange> next_change_;
};

}  // namespace vesica::io
