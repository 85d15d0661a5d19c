#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "vesica/config/config.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/relax/verdict.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// An observer that writes the files of a run (docs/output.md): `trajectory.h5`, the record;
/// `trajectory.xdmf`, which lets ParaView open it; at the end also `verdict.json` and the effective
/// configuration `case.toml`. While the run goes on the first two are called `trajectory.part.h5`
/// and `trajectory.part.xdmf`. The disk has every frame when the call that wrote it returns, and a
/// kill loses none; finish() gives the files their names, so an older run in the folder stays whole
/// until then.
class TrajectoryWriter final : public relax::Observer {
 public:
  /// Begins a record in `folder`, which exists, and holds its FolderLock; where `vesicle` was
  /// resumed from this folder, its record goes on, with steps, counts and seconds. Throws IoError,
  /// and ConfigError when a run is writing there or has done so since the case was made, or when
  /// the folder holds a run and `replaces` is false.
  TrajectoryWriter(std::filesystem::path folder, const config::RunConfig& config,
                   const setup::Case& vesicle, bool replaces = true);
  ~TrajectoryWriter() override;

  /// Writes a row of the time series; and a frame for step 0 and every `output.every_steps` steps.
  /// Throws IoError, after which nothing more is written.
  void observe(const relax::StepView& view) override;
  /// Writes a frame on the new mesh, which adds its connectivity. Throws IoError.
  void mesh_changed(const relax::StepView& view, const relax::MeshChange& change) override;
  /// Writes the event with its step and time. Throws IoError.
  void happened(const relax::StepView& view, const relax::Event& event) override;
  /// Writes the final frame, the outcome and the verdict, and gives the files the names of a
  /// finished run. Throws IoError.
  void finish(const relax::StepView& view, const relax::Outcome& outcome) override;
  /// The verdict on the whole run, with its parts before the last resumption; only after finish().
  [[nodiscard]] const std::optional<relax::Verdict>& verdict() const { return verdict_; }

 private:
  class Writer;

  template <class Write>
  void write(const Write& write);

  std::unique_ptr<Writer> writer_;
  std::optional<relax::Verdict> verdict_;
};

}  // namespace vesica::io
