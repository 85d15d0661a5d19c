#include "io/trajectory_file.hpp"

#include <fmt/format.h>
#include <map>
#include <utility>

#include "config/option_values.hpp"
#include "vesica/core/version.hpp"
#include "vesica/flow/library_versions.hpp"
#include "vesica/linalg/library_versions.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {
namespace {

#if defined(__clang__)
constexpr std::string_view compiler = "Clang " __clang_version__;
#else
constexpr std::string_view compiler = "GCC " __VERSION__;
#endif

std::string numbered(std::string_view group, std::size_t index) {
  return fmt::format("/{}/{:06}", group, index);
}

std::span<const double> values_of(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

std::span<const double> values_of(const mesh::Positions& positions) {
  return {positions.data(), static_cast<std::size_t>(positions.size())};
}

/// One attribute for every option or result: numbers and flags as such, everything else as in a
/// case file.
class AttributeWriter {
 public:
  AttributeWriter(hdf5::WritableFile& file, std::string group, std::string prefix = "")
      : file_(file), group_(std::move(group)), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    const std::string name = fmt::format("{}{}", prefix_, field.name);
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::string>) {
      file_.set_attribute(group_, name, value);
    } else if constexpr (std::is_integral_v<T>) {
      file_.set_attribute(group_, name, static_cast<std::int64_t>(value));
    } else if constexpr (std::is_enum_v<T>) {
      file_.set_attribute(group_, name, std::string(name_of(value)));
    } else {
      file_.set_attribute(group_, name, config::toml_text(value));
    }
  }
  template <class T>
  void operator()(const Field& field, const std::optional<T>& value) {
    if (value) (*this)(field, *value);
  }

 private:
  hdf5::WritableFile& file_;
  std::string group_;
  std::string prefix_;
};

}  // namespace

TrajectoryFile::TrajectoryFile(const std::filesystem::path& path, const config::RunConfig& config,
                               const setup::Case& vesicle)
    : file_(path), model_(vesicle.model) {
  for (const char* group : {"/meshes", "/frames", "/series", "/domains", "/events"})
    file_.make_group(group);
  write_configuration(config);
  write_origin(vesicle.origin);
  write_versions();
}

void TrajectoryFile::write_configuration(const config::RunConfig& config) {
  const std::string root = "/configuration";
  file_.make_group(root);
  file_.set_attribute(root, "title", config.title);
  file_.write_text(root + "/toml", config::to_toml(config));
  config::RunConfig::tables(
      config, [this, &root]<class Options>(const config::Table& table, const Options& options) {
        const std::string group = fmt::format("{}/{}", root, table.name);
        if constexpr (requires { options.has_value(); }) {
          if (!options) return;
          file_.make_group(group);
          Options::value_type::fields(*options, AttributeWriter(file_, group));
        } else {
          file_.make_group(group);
          Options::fields(options, AttributeWriter(file_, group));
        }
      });
}

void TrajectoryFile::write_origin(const setup::Origin& origin) {
  const std::string group = "/origin";
  file_.make_group(group);
  model::Measures::fields(origin.measures, AttributeWriter(file_, group));
  file_.set_attribute(group, "is_sphere", static_cast<std::int64_t>(origin.is_sphere));
}

void TrajectoryFile::write_versions() {
  const std::string group = "/versions";
  file_.make_group(group);
  file_.set_attribute(group, "vesica", std::string(version()));
  file_.set_attribute(group, "sundials", flow::sundials_version());
  file_.set_attribute(group, "suitesparse", linalg::suitesparse_versions());
  file_.set_attribute(group, "hdf5",
                      fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE));
  file_.set_attribute(
      group, "eigen",
      fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  file_.set_attribute(group, "compiler", std::string(compiler));
}

void TrajectoryFile::write_mesh(std::shared_ptr<const mesh::Triangulation> triangulation) {
  const std::string mesh = numbered("meshes", meshes_.size());
  const std::span<const mesh::QuadraticTriangle> triangles = triangulation->triangles();
  file_.make_group(mesh);
  file_.write(mesh + "/triangles", std::span(triangles.front().data(), 6 * triangles.size()), 6);
  if (next_change_) {
    relax::MeshChange::fields(*next_change_, AttributeWriter(file_, mesh));
    next_change_.reset();
  }
  meshes_.push_back(mesh);
  last_triangulation_ = std::move(triangulation);
}

void TrajectoryFile::add_row(const relax::StepView& view) { rows_.push_back(series_row(view)); }

void TrajectoryFile::add_frame(const relax::StepView& view) {
  const problem::State& state = view.state;
  if (state.triangulation != last_triangulation_) write_mesh(state.triangulation);
  const std::string group = numbered("frames", frames_.size());
  const measure::NodalFields fields = measure::nodal_fields(model_, state);
  file_.make_group(group);
  file_.set_attribute(group, "time", state.time);
  file_.set_attribute(group, "step", static_cast<std::int64_t>(view.report.counts.steps));
  file_.set_attribute(group, "mesh", meshes_.back());
  file_.set_attribute(group, "damping", state.damping);
  model::PerConstraint::fields(state.values.multipliers,
                               AttributeWriter(file_, group, "multiplier_"));
  file_.link(group + "/mesh", meshes_.back());
  file_.write(group + "/positions", values_of(state.values.positions), 3);
  file_.write(group + "/velocity", values_of(state.rates.positions), 3);
  file_.write(group + "/normals", values_of(fields.normals), 3);
  file_.write(group + "/mean_curvature", values_of(state.values.mean_curvature));
  if (state.is_two_phase())
    file_.write(group + "/order_parameter", values_of(state.values.order_parameter));
  file_.write(group + "/normal_velocity", values_of(fields.normal_velocity));
  file_.write(group + "/bending_energy_density", values_of(fields.bending_energy_density));
  write_domains(view.diagnostics);
  frames_.push_back({state.time, group, meshes_.back(), state.triangulation->num_nodes(),
                     state.triangulation->num_triangles(), state.is_two_phase()});
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

void TrajectoryFile::add_outcome(const relax::StepView& view, const relax::Outcome& outcome) {
  const std::string group = "/outcome";
  file_.make_group(group);
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
