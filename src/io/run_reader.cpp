#include "vesica/io/run_reader.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "io/hdf5_reader.hpp"
#include "io/json_reader.hpp"
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
  [[nodiscard]] problem::State last() const { return frame(num_frames() - 1); }
  /// A run that broke off may have done so within its last frame.
  [[nodiscard]] problem::State last_complete() const {
    if (num_frames() == 1) return last();
    try {
      return last();
    } catch (const IoError&) {
      return frame(num_frames() - 2);
    }
  }

 private:
  [[nodiscard]] std::size_t num_frames() const { return file_.count("/frames"); }
  [[nodiscard]] problem::State frame(std::size_t index) const {
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
  });
  for (const std::string_view needed : {model::Volume::key, model::Area::key})
    (void)file.number_attribute(group, std::string(needed));
  origin.is_sphere = file.number_attribute(group, "is_sphere") != 0;
  return origin;
}

model::PerConstraint per_constraint(const JsonReader& json, const std::string& object) {
  model::PerConstraint result;
  model::PerConstraint::fields(result, [&](const Field& field, auto& value) {
    value = json.optional_number(fmt::format("{}/{}", object, field.name));
  });
  return result;
}

measure::ShapeNumbers shape_of(const JsonReader& json) {
  measure::ShapeNumbers shape;
  shape.characteristic_radius = json.number("/shape/characteristic_radius");
  shape.reduced_volume = json.number("/shape/reduced_volume");
  shape.phase_fraction = json.optional_number("/shape/phase_fraction");
  shape.reduced_line_tension = json.optional_number("/shape/reduced_line_tension");
  shape.rigidity_ratio = json.optional_number("/shape/rigidity_ratio");
  shape.saddle_splay_difference = json.optional_number("/shape/saddle_splay_difference");
  shape.neck_radius = json.optional_number("/shape/neck_radius");
  shape.length = json.optional_number("/shape/length");
  shape.domains_1 = json.optional_count("/domains/phase_1");
  shape.domains_2 = json.optional_count("/domains/phase_2");
  return shape;
}

/// Areas and boundary lengths; their centroids stand in the trajectory.
std::vector<measure::PhaseDomain> domains_of(const JsonReader& json) {
  std::vector<measure::PhaseDomain> domains;
  for (const int phase : {1, 2}) {
    const std::string areas = fmt::format("/domains/areas/phase_{}", phase);
    const std::string lengths = fmt::format("/domains/boundary_lengths/phase_{}", phase);
    for (std::size_t i = 0; i < json.size(areas); ++i) {
      domains.push_back({phase, json.number(fmt::format("{}/{}", areas, i)),
                         json.number(fmt::format("{}/{}", lengths, i))});
    }
  }
  return domains;
}

measure::Diagnostics diagnostics_of(const JsonReader& json) {
  measure::Diagnostics measured;
  model::EnergyParts::fields(measured.energy, [&](const Field& field, auto& value) {
    value = json.optional_number(fmt::format("/energy/{}", field.name));
  });
  model::Measures::fields(measured.measures, [&](const Field& field, auto& value) {
    value = json.optional_number(fmt::format("/shape/{}", field.name));
  });
  measured.constraint_errors = per_constraint(json, "/constraints");
  const double radius = json.number("/shape/characteristic_radius");
  measured.velocity = {radius * json.number("/normal_velocity_plain"),
                       radius * json.number("/normal_velocity"),
                       radius * json.number("/tangential_velocity")};
  measured.quality = json.number("/mesh/quality");
  measured.domains = domains_of(json);
  return measured;
}

std::vector<relax::Event> events_of(const JsonReader& json) {
  std::vector<relax::Event> events(json.size("/events"));
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::string event = fmt::format("/events/{}", i);
    events[i] = {json.count(event + "/step"), json.number(event + "/time"),
                 json.text(event + "/what")};
  }
  return events;
}

std::optional<solve::PolishReport> polish_of(const JsonReader& json) {
  const auto iterations = json.optional_count("/polish/iterations");
  if (!iterations) return std::nullopt;
  solve::PolishReport polish;
  polish.is_converged = true;  // a run whose polish fails does not end as converged
  polish.iterations = *iterations;
  polish.gradient = json.optional_number("/polish/gradient").value_or(0);
  polish.curvature.value = json.optional_number("/polish/lowest_curvature").value_or(0);
  return polish;
}

solve::StepReport report_of(const JsonReader& json) {
  solve::StepReport report;
  report.gradient = json.optional_number("/gradient");
  report.polish = polish_of(json);
  report.time = json.number("/time");
  solve::SolverCounts& counts = report.counts;
  counts.steps = json.count("/counts/steps");
  counts.newton = json.count("/counts/newton");
  counts.krylov = json.count("/counts/krylov");
  counts.residuals = json.count("/counts/residuals");
  counts.jacobians = json.count("/counts/jacobians");
  counts.factorisations = json.count("/counts/factorisations");
  counts.failures = json.count("/counts/failures");
  solve::SolverSeconds& seconds = report.seconds;
  seconds.total = json.number("/seconds/total");
  seconds.processor = json.number("/seconds/processor");
  seconds.residual = json.number("/seconds/residual");
  seconds.jacobian = json.number("/seconds/jacobian");
  seconds.factorisation = json.number("/seconds/factorisation");
  seconds.solve = json.number("/seconds/solve");
  return report;
}

relax::RunStatus status_named(const std::string& name, const fs::path& file) {
  using relax::RunStatus;
  for (const RunStatus status :
       {RunStatus::converged, RunStatus::time_limit, RunStatus::step_limit, RunStatus::stopped,
        RunStatus::neck_closes, RunStatus::budding, RunStatus::self_intersection,
        RunStatus::interrupted, RunStatus::numerical_failure}) {
    if (relax::status_name(status) == name) return status;
  }
  throw IoError(fmt::format("{}: /status \"{}\" is not known", file.string(), name));
}

relax::Verdict read_verdict(const fs::path& file) {
  const JsonReader json(file);
  relax::Verdict verdict;
  verdict.outcome.status = status_named(json.text("/status"), file);
  verdict.outcome.reason = json.text("/reason");
  verdict.outcome.diagnostics = diagnostics_of(json);
  verdict.outcome.report = report_of(json);
  verdict.outcome.initial_quality = json.number("/mesh/quality_initial");
  verdict.outcome.smallest_quality = json.number("/mesh/quality_smallest");
  verdict.area_ratio = json.number("/mesh/area_ratio");
  verdict.smallest_normal_cosine = json.number("/mesh/smallest_normal_cosine");
  // How many there were; when and why stands in the trajectory.
  verdict.outcome.mesh_changes.resize(static_cast<std::size_t>(json.count("/mesh/remeshings")));
  verdict.outcome.events = events_of(json);
  verdict.method = json.text("/method");
  verdict.scheme = json.text("/scheme");
  verdict.time = json.number("/time");
  verdict.multipliers = per_constraint(json, "/multipliers");
  verdict.shape = shape_of(json);
  verdict.num_nodes = static_cast<std::int32_t>(json.count("/mesh/nodes"));
  verdict.num_triangles = static_cast<std::int32_t>(json.count("/mesh/triangles"));
  return verdict;
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
