#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "vesica/config/config.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// An observer that writes `trajectory.h5`, the record of a run (layout: docs/output.md), and
/// `trajectory.xdmf`, which lets ParaView open it. While the run goes on they are called
/// `trajectory.part.h5` and `trajectory.part.xdmf` and are complete up to the last frame; finish()
/// gives them their names, so an older run in the folder stays whole until then.
class TrajectoryWriter final : public relax::Observer {
 public:
  /// Makes `trajectory.part.h5` in `folder`, which exists, and holds its FolderLock. Throws
  /// IoError, and ConfigError when a run is writing there.
  TrajectoryWriter(std::filesystem::path folder, const config::RunConfig& config,
                   const setup::Case& vesicle);
  ~TrajectoryWriter() override;

  /// Writes a row of the time series; and a frame for step 0 and every `output.every_steps` steps.
  /// Throws IoError, after which nothing more is written.
  void observe(const relax::StepView& view) override;
  /// Writes a frame on the new mesh, which adds its connectivity. Throws IoError.
  void mesh_changed(const relax::StepView& view, const relax::MeshChange& change) override;
  /// Writes the event with its step and time. Throws IoError.
  void happened(const relax::StepView& view, const relax::Event& event) override;
  /// Writes the final frame and the outcome, and gives the files the names of a finished run.
  /// Throws IoError.
  void finish(const relax::StepView& view, const relax::Outcome& outcome) override;

 private:
  class Writer;

  template <class Write>
  void write(const Write& write);

  std::unique_ptr<Writer> writer_;
};

}  // namespace vesica::io
