#include "vesica/io/run_reader.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "io/hdf5/readable_file.hpp"
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
  for (const char* name : {"trajectory.h5", "case.toml", "verdict.json"}) {
    if (fs::is_regular_file(folder / name, ignored)) continue;
    const bool goes_on = fs::exists(folder / "trajectory.part.h5", ignored);
    throw IoError(fmt::format("{}: holds no finished run ({} is missing{})", folder.string(), name,
                              goes_on ? "; the run goes on or broke off" : ""));
  }
}

/// A run that has ended or, where there is none, one that broke off.
struct Resumable {
  fs::path trajectory;
  bool has_ended = true;
};

Resumable find_resumable(const fs::path& folder) {
  const fs::path part = folder / "trajectory.part.h5";
  std::error_code ignored;
  if (fs::exists(folder / "trajectory.h5", ignored) || !fs::exists(part, ignored)) {
    check_has_ended(folder);
    return {folder / "trajectory.h5", true};
  }
  const FolderLock nobody_writes(folder);
  return {part, false};
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The frames of a trajectory as states.
class FrameReader {
 public:
  explicit FrameReader(const hdf5::ReadableFile& file) : file_(file) {
    if (file.count("/frames") == 0) file.refuse("/frames", "is empty");
  }
  [[nodiscard]] problem::State last() const { return at(num_frames() - 1); }
  /// A run that broke off may have done so within its last frame.
  [[nodiscard]] problem::State last_complete() const {
    if (num_frames() == 1) return last();
    try {
      return last();
    } catch (const IoError&) {
      return at(num_frames() - 2);
    }
  }
  [[nodiscard]] std::size_t num_frames() const { return file_.count("/frames"); }
  [[nodiscard]] problem::State at(std::size_t index) const {
    const std::string group = fmt::format("/frames/{:06}", index);
    problem::State state;
    state.time = file_.number_attribute(group, "time");
    state.damping = file_.number_attribute(group, "damping");
    state.values.positions = positions(group + "/positions");
    const Eigen::Index num_nodes = state.values.positions.rows();
    state.triangulation = triangulation(group + "/mesh/triangles", num_nodes);
    state.values.mean_curvature = scalar(group + "/mean_curvature", num_nodes);
    state.rates.positions = positions(group + "/velocity");
    state.rates.mean_curvature = Eigen::VectorXd::Zero(num_nodes);
    if (file_.has(group + "/order_parameter")) {
      state.values.order_parameter = scalar(group + "/order_parameter", num_nodes);
      state.rates.order_parameter = Eigen::VectorXd::Zero(num_nodes);
    }
    model::PerConstraint::fields(state.values.multipliers, [&](const Field& field, auto& value) {
      value = file_.find_attribute(group, fmt::format("multiplier_{}", field.name));
    });
    return state;
  }

 private:
  [[nodiscard]] mesh::Positions positions(const std::string& path) const {
    const std::vector<double> values = file_.numbers(path);
    if (values.size() % 3 != 0) file_.refuse(path, "must have three columns");
    return Eigen::Map<const mesh::Positions>(values.data(),
                                             static_cast<Eigen::Index>(values.size() / 3), 3);
  }
  [[nodiscard]] Eigen::VectorXd scalar(const std::string& path, Eigen::Index num_nodes) const {
    Eigen::VectorXd values = vector_of(file_.numbers(path));
    if (values.size() != num_nodes) file_.refuse(path, "must have one value a node");
    return values;
  }
  [[nodiscard]] std::shared_ptr<const mesh::Triangulation> triangulation(
      const std::string& path, Eigen::Index num_nodes) const {
    const std::vector<std::int32_t> nodes = file_.integers(path);
    if (nodes.size() % 6 != 0) file_.refuse(path, "must have six columns");
    std::vector<mesh::QuadraticTriangle> triangles(nodes.size() / 6);
    for (std::size_t i = 0; i < nodes.size(); ++i) triangles[i / 6][i % 6] = nodes[i];
    try {
      return std::make_shared<const mesh::Triangulation>(std::move(triangles),
                                                         static_cast<mesh::NodeIndex>(num_nodes));
    } catch (const ConfigError& error) {
      file_.refuse(path, error.what());
    }
  }

  const hdf5::ReadableFile& file_;
};

setup::Origin origin_of(const hdf5::ReadableFile& file) {
  const std::string group = "/origin";
  if (!file.has(group)) file.refuse(group, "is missing: an older version wrote the file");
  setup::Origin origin;
  model::Measures::fields(origin.measures, [&](const Field& field, auto& value) {
    value = file.find_attribute(group, std::string(field.name));
    if (!value && field.name != model::PhaseDifference::key)
      file.refuse(fmt::format("{}@{}", group, field.name), "is missing");
  });
  origin.is_sphere = file.number_attribute(group, "is_sphere") != 0;
  return origin;
}

compare::EnergyHistory history_of(const hdf5::ReadableFile& file) {
  return {file.numbers("/series/step"), file.numbers("/series/seconds_processor"),
          file.numbers("/series/energy_total")};
}

/// The exit status of an interrupted run is 128 + signal.
int signal_of(const hdf5::ReadableFile& file) {
  return static_cast<int>(file.number_attribute("/outcome", "exit_status")) - 128;
}

}  // namespace

compare::EnergyHistory read_history(const fs::path& folder) {
  return history_of(hdf5::ReadableFile(folder / "trajectory.h5"));
}

Frame read_frame(const fs::path& folder, std::optional<std::size_t> index) {
  std::error_code ignored;
  const bool goes_on = !fs::exists(folder / "trajectory.h5", ignored) &&
                       fs::exists(folder / "trajectory.part.h5", ignored);
  const hdf5::ReadableFile file(folder / (goes_on ? "trajectory.part.h5" : "trajectory.h5"));
  const FrameReader frames(file);
  const std::size_t count = frames.num_frames();
  if (index && *index >= count) {
    throw ConfigError(
        fmt::format("{}: frame {}: must be in [0, {})", folder.string(), *index, count));
  }
  const std::size_t chosen = index.value_or(count - 1);
  return {frames.at(chosen), chosen, count};
}

FinishedRun read_run(const fs::path& folder) {
  check_has_ended(folder);
  FinishedRun run;
  run.config = config::read_config((folder / "case.toml").string(), {});
  const hdf5::ReadableFile file(folder / "trajectory.h5");
  const FrameReader frames(file);
  run.state = frames.last();
  run.model = setup::case_of(run.config, run.state, origin_of(file)).model;
  run.verdict = read_verdict(folder / "verdict.json");
  if (run.verdict.num_nodes != run.state.triangulation->num_nodes())
    file.refuse("/frames", "and verdict.json differ in the number of nodes");
  if (run.verdict.outcome.status == relax::RunStatus::interrupted)
    run.verdict.outcome.signal = signal_of(file);
  run.history = history_of(file);
  return run;
}

setup::Case resumed_case(const config::RunConfig& config, const fs::path& folder) {
  const Resumable run = find_resumable(folder);
  const hdf5::ReadableFile file(run.trajectory);
  const FrameReader frames(file);
  problem::State last = run.has_ended ? frames.last() : frames.last_complete();
  if (last.is_two_phase() != config.phase.has_value()) {
    throw ConfigError(fmt::format("{}: the run has {} phase field, the case has {}",
                                  folder.string(), config.phase ? "no" : "a",
                                  config.phase ? "one" : "none"));
  }
  return setup::case_of(config, std::move(last), origin_of(file));
}

}  // namespace vesica::io
