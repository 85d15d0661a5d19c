#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/writable_file.hpp"
#include "io/time_series.hpp"
#include "io/xdmf.hpp"
#include "vesica/config/config.hpp"
#include "vesica/model/model.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// The groups of `trajectory.h5` (docs/output.md) and how they grow.
class TrajectoryFile {
 public:
  /// Makes the file with `/configuration`, `/origin` and `/versions`.
  TrajectoryFile(const std::filesystem::path& path, const config::RunConfig& config,
                 const setup::Case& vesicle);

  /// Kept until the next flush.
  void add_row(const relax::StepView& view);
  /// A frame, and its mesh when the connectivity is new.
  void add_frame(const relax::StepView& view);
  /// What the next frame's mesh is there for: attributes of its mesh group.
  void add_mesh_change(const relax::MeshChange& change) { next_change_ = change; }
  /// Kept until the next flush.
  void add_event(const relax::Event& event) { events_.push_back(event); }
  void add_outcome(const relax::StepView& view, const relax::Outcome& outcome);
  /// Rows, frames and events reach the disk.
  void flush();
  void close() { file_.close(); }
  [[nodiscard]] const std::vector<XdmfFrame>& frames() const { return frames_; }

 private:
  void write_configuration(const config::RunConfig& config);
  void write_origin(const setup::Origin& origin);
  void write_versions();
  void write_domains(const measure::Diagnostics& diagnostics);
  void write_mesh(std::shared_ptr<const mesh::Triangulation> triangulation);

  hdf5::WritableFile file_;
  model::Model model_;
  std::vector<std::vector<Number>> rows_;
  std::vector<relax::Event> events_;
  std::size_t num_written_events_ = 0;
  std::vector<XdmfFrame> frames_;
  std::vector<std::string> meshes_;
  std::shared_ptr<const mesh::Triangulation> last_triangulation_;
  std::optional<relax::MeshChange> next_change_;
};

}  // namespace vesica::io
