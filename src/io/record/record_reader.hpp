#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/readable_file.hpp"
#include "io/record/xdmf.hpp"
#include "vesica/compare/comparison.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/setup/case.hpp"

namespace vesica::io {

/// How far a record goes up to one of its frames: what a run that goes on keeps of it.
struct RecordEnd {
  std::vector<XdmfFrame> frames;
  long step = 0;  ///< of the last frame
  std::size_t num_meshes = 0;
  std::size_t num_rows = 0;  ///< of the time series
  std::size_t num_domain_rows = 0;
  std::vector<std::string> columns;         ///< of the time series
  std::vector<std::string> domain_columns;  ///< of the table of domains
  /// Events, changes of the mesh, qualities, counts and seconds so far.
  relax::Outcome outcome;
};

/// A frame as a state.
struct RecordFrame {
  std::size_t index = 0;
  problem::State state;
  double step_size = 0;  ///< of the step that led to it; 0: unknown
  std::string warning;   ///< names the damaged frames behind it; empty: there are none
};

/// Reads the record of a run (docs/output.md), ended or not. Everything throws IoError, which names
/// file, object and rule.
class RecordReader {
 public:
  explicit RecordReader(const std::filesystem::path& path);

  /// The random number that the files of one run share; empty in files of older versions.
  [[nodiscard]] std::string run() const;
  /// Text of case.toml.
  [[nodiscard]] std::string configuration() const;
  /// Whether `trajectory.xdmf` belongs to it.
  [[nodiscard]] bool has_xdmf() const;
  /// Text of verdict.json, of a run that has ended.
  [[nodiscard]] std::optional<std::string> verdict() const;
  /// Signal that interrupted a run.
  [[nodiscard]] int signal() const;
  [[nodiscard]] setup::Origin origin() const;
  [[nodiscard]] compare::EnergyHistory history() const;

  [[nodiscard]] std::size_t num_frames() const { return num_frames_; }
  [[nodiscard]] RecordFrame frame(std::size_t index) const;
  [[nodiscard]] RecordFrame last() const { return frame(num_frames_ - 1); }
  /// The last frame that can be read whole.
  [[nodiscard]] RecordFrame last_good() const;
  /// All frames as XDMF has to know them.
  [[nodiscard]] std::vector<XdmfFrame> frames() const { return frames(num_frames_); }
  /// The end of the record when it is cut behind `num_frames` frames.
  [[nodiscard]] RecordEnd end(std::size_t num_frames) const;

 private:
  [[nodiscard]] std::vector<XdmfFrame> frames(std::size_t count) const;
  void read_series(RecordEnd& end) const;
  void read_events(RecordEnd& end) const;

  hdf5::ReadableFile file_;
  std::size_t num_frames_ = 0;
};

/// Path of a numbered object, "/frames/000012".
[[nodiscard]] std::string numbered(std::string_view group, std::size_t index);

}  // namespace vesica::io
