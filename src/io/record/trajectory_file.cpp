#include "io/record/trajectory_file.hpp"

#include <fmt/format.h>
#include <map>
#include <utility>

#include "io/record/attributes.hpp"
#include "io/record/run_description.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {
namespace {

std::span<const double> values_of(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

std::span<const double> values_of(const mesh::Positions& positions) {
  return {positions.data(), static_cast<std::size_t>(positions.size())};
}

}  // namespace

TrajectoryFile::TrajectoryFile(const std::filesystem::path& path, const std::string& run,
                               const config::RunConfig& config, const setup::Case& vesicle)
    : file_(path), model_(vesicle.model) {
  for (const char* group : {"/meshes", "/frames", "/series", "/domains", "/events"})
    file_.make_group(group);
  file_.set_attribute("/", "run", run);
  write_configuration(file_, config);
  write_origin(file_, vesicle.origin);
  write_versions(file_);
  add_provenance(file_, vesicle);
}

TrajectoryFile::TrajectoryFile(const std::filesystem::path& path, const RecordEnd& end,
                               const config::RunConfig& config, const setup::Case& vesicle)
    : file_(path, hdf5::Access::change),
      model_(vesicle.model),
      num_written_events_(end.outcome.events.size()),
      frames_(end.frames),
      num_meshes_(end.num_meshes),
      last_triangulation_(vesicle.start.triangulation) {
  cut_behind(end);
  write_configuration(file_, config);
  write_versions(file_);
  add_provenance(file_, vesicle);
}

/// Removes what the run that goes on will write anew, and the end of the run.
void TrajectoryFile::cut_behind(const RecordEnd& end) {
  if (file_.has("/outcome")) file_.remove("/outcome");
  for (const auto& [group, first] :
       {std::pair{"frames", end.frames.size()}, std::pair{"meshes", end.num_meshes},
        std::pair{"events", end.outcome.events.size()}}) {
    for (std::size_t index = first; file_.has(numbered(group, index)); ++index)
      file_.remove(numbered(group, index));
  }
  for (const std::string& column : end.columns) file_.shorten("/series/" + column, end.num_rows);
  for (const std::string& column : end.domain_columns)
    file_.shorten("/domains/" + column, end.num_domain_rows);
}

void TrajectoryFile::write_mesh(std::shared_ptr<const mesh::Triangulation> triangulation) {
  const std::string mesh = numbered("meshes", num_meshes_);
  const std::span<const mesh::QuadraticTriangle> triangles = triangulation->triangles();
  file_.make_group(mesh);
  file_.write(mesh + "/triangles", std::span(triangles.front().data(), 6 * triangles.size()), 6);
  if (next_change_) {
    relax::MeshChange::fields(*next_change_, AttributeWriter(file_, mesh));
    next_change_.reset();
  }
  ++num_meshes_;
  last_triangulation_ = std::move(triangulation);
}

void TrajectoryFile::add_row(const relax::StepView& view) { rows_.push_back(series_row(view)); }

void TrajectoryFile::add_frame(const relax::StepView& view) {
  const problem::State& state = view.state;
  if (state.triangulation != last_triangulation_) write_mesh(state.triangulation);
  const std::string group = numbered("frames", frames_.size());
  const std::string mesh = numbered("meshes", num_meshes_ - 1);
  const measure::NodalFields fields = measure::nodal_fields(model_, state);
  file_.make_group(group);
  file_.set_attribute(group, "time", state.time);
  file_.set_attribute(group, "step", static_cast<std::int64_t>(view.report.counts.steps));
  file_.set_attribute(group, "mesh", mesh);
  file_.set_attribute(group, "step_size", view.report.step_size);
  file_.set_attribute(group, "damping", state.damping);
  model::PerConstraint::fields(state.values.multipliers,
                               AttributeWriter(file_, group, "multiplier_"));
  file_.link(group + "/mesh", mesh);
  file_.write(group + "/positions", values_of(state.values.positions), 3);
  file_.write(group + "/velocity", values_of(state.rates.positions), 3);
  file_.write(group + "/normals", values_of(fields.normals), 3);
  file_.write(group + "/mean_curvature", values_of(state.values.mean_curvature));
  if (state.is_two_phase()) {
    file_.write(group + "/order_parameter", values_of(state.values.order_parameter));
    file_.write(group + "/order_parameter_rate", values_of(state.rates.order_parameter));
  }
  file_.write(group + "/normal_velocity", values_of(fields.normal_velocity));
  file_.write(group + "/bending_energy_density", values_of(fields.bending_energy_density));
  write_domains(view.diagnostics);
  frames_.push_back({state.time, group, mesh, state.triangulation->num_nodes(),
                     state.triangulation->num_triangles(), state.is_two_phase(),
                     view.report.counts.steps});
}

/// Rows of the domains' table for the frame that is being added.
void TrajectoryFile::write_domains(const measure::Diagnostics& diagnostics) {
  std::map<std::string, std::vector<double>> columns;
  for (const measure::PhaseDomain& domain : diagnostics.domains) {
    columns["frame"].push_back(static_cast<double>(frames_.size()));
    measure::PhaseDomain::fields(domain, [&]<class T>(const Field& field, const T& value) {
      const std::string name(field.name);
      if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
        for (int axis = 0; axis < 3; ++axis)
          columns[fmt::format("{}_{}", name, "xyz"[axis])].push_back(value[axis]);
      } else {
        columns[name].push_back(value);
      }
    });
  }
  for (const auto& [name, values] : columns) file_.append("/domains/" + name, values);
}

void TrajectoryFile::add_outcome(const relax::StepView& view, const relax::Outcome& outcome,
                                 const std::string& verdict) {
  const std::string group = "/outcome";
  file_.make_group(group);
  file_.write_text(group + "/verdict", verdict);
  file_.set_attribute(group, "status", std::string(name_of(outcome.status)));
  file_.set_attribute(group, "reason", outcome.reason);
  file_.set_attribute(group, "exit_status", static_cast<std::int64_t>(exit_status(outcome)));
  file_.set_attribute(group, "time", view.state.time);
  file_.set_attribute(group, "steps", static_cast<std::int64_t>(outcome.report.counts.steps));
  file_.set_attribute(group, "quality_initial", outcome.initial_quality);
  file_.set_attribute(group, "quality_smallest", outcome.smallest_quality);
  if (!outcome.report.polish) return;
  const solve::Curvature& curvature = outcome.report.polish->curvature;
  file_.set_attribute(group, "lowest_curvature", curvature.value);
  if (curvature.mode.size() > 0)
    file_.write(group + "/least_stable_mode", values_of(curvature.mode));
}

void TrajectoryFile::flush() {
  for (std::size_t column = 0; !rows_.empty() && column < rows_.front().size(); ++column) {
    std::vector<double> values;
    for (const std::vector<Number>& row : rows_) values.push_back(row[column].value);
    file_.append("/series/" + rows_.front()[column].path, values);
  }
  rows_.clear();
  for (const relax::Event& event : events_) {
    const std::string group = numbered("events", num_written_events_++);
    file_.make_group(group);
    relax::Event::fields(event, AttributeWriter(file_, group));
  }
  events_.clear();
  file_.flush();
}

}  // namespace vesica::io
