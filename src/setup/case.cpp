#include "vesica/setup/case.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "problem/zero_fields.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/paper/bisection.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::setup {
namespace {

problem::State state_at_rest(const mesh::Surface& surface) {
  problem::State state;
  state.triangulation = surface.triangulation;
  state.rates = problem::zero_fields(surface.positions.rows(), false);
  state.values = state.rates;
  state.values.positions = surface.positions;
  return state;
}

void add_order_parameter(problem::State& state, Eigen::VectorXd order_parameter) {
  state.rates.order_parameter = Eigen::VectorXd::Zero(order_parameter.size());
  state.values.order_parameter = std::move(order_parameter);
}

/// How far the bending energy is indefinite in one phase at any time, |k_g^(1) - k_g^(2)| - 2 min
/// k_kappa, with the two numbers. Between its kinks the material changes linearly.
struct Indefiniteness {
  double contrast = 0;
  double rigidity = 0;
  [[nodiscard]] double excess() const { return contrast - 2 * rigidity; }
};

Indefiniteness most_indefinite(const model::Model& model) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Indefiniteness worst{0, infinity};
  const auto look_at = [&](double time) {
    const model::Material material = model.material.at(time);
    const Indefiniteness now{
        std::abs(material.gaussian_rigidity.difference()),
        std::min(material.bending_rigidity.phase_1, material.bending_rigidity.phase_2)};
    if (now.excess() > worst.excess()) worst = now;
  };
  look_at(-infinity);
  for (double kink = model.next_kink(-infinity); kink < infinity; kink = model.next_kink(kink)) {
    look_at(kink);
    look_at(std::nextafter(kink, infinity));
  }
  return worst;
}

/// Of the elements that are not in one pure phase.
double longest_edge_in_interface(const problem::State& state) {
  constexpr double pure = 0.9;
  const Eigen::VectorXd edges = paper::diameters(state.surface());
  double longest = 0;
  Eigen::Index t = 0;
  for (const mesh::QuadraticTriangle& nodes : state.triangulation->triangles()) {
    const Eigen::Vector3d c = state.values.order_parameter({nodes[0], nodes[1], nodes[2]});
    const double edge = edges[t++];
    if (c.minCoeff() <= pure && c.maxCoeff() >= -pure) longest = std::max(longest, edge);
  }
  return longest;
}

template <class Options>
void warn_of_unused(std::string_view table, const Options& options,
                    std::vector<std::string>& warnings) {
  for_each_unused(options, options.kind, [&](const Field& field, const auto&) {
    warnings.push_back(fmt::format("{0}.{1} means nothing with {0}.kind = \"{2}\"", table,
                                   field.name, name_of(options.kind)));
  });
}

std::vector<std::string> warnings_of(const config::RunConfig& config, const Case& vesicle) {
  const model::Model& model = vesicle.model;
  std::vector<std::string> warnings;
  warn_of_unused("shape", config.shape, warnings);
  if (config.phase) warn_of_unused("phase", *config.phase, warnings);
  if (!model.is_two_phase) return warnings;
  const double width = model.material.interface_width.value(vesicle.start.time);
  const double edge = config.adaption.enabled ? 0 : longest_edge_in_interface(vesicle.start);
  if (edge > width) {
    warnings.push_back(
        fmt::format("the mesh does not resolve the phase interface: an edge of {:.4g} in it > "
                    "material.interface_width = {:.4g}",
                    edge, width));
  }
  const auto [contrast, rigidity] = most_indefinite(model);
  if (contrast > 2 * rigidity) {
    warnings.push_back(
        fmt::format("the bending energy is indefinite in one phase: |k_g^(1) - k_g^(2)| = {:.4g} > "
                    "2 min(k_kappa) = {:.4g}",
                    contrast, 2 * rigidity));
  }
  return warnings;
}

/// Whether all nodes have the same distance, to 1e-4 of it, from the centre of the best-fit sphere.
bool is_sphere(const mesh::Positions& positions) {
  // |x|^2 = 2 centre . x + rest, linear least squares
  Eigen::MatrixX4d matrix(positions.rows(), 4);
  matrix << 2 * positions, Eigen::VectorXd::Ones(positions.rows());
  const Eigen::VectorXd squares = positions.rowwise().squaredNorm();
  const Eigen::Vector4d fit =
      (matrix.transpose() * matrix).inverse() * (matrix.transpose() * squares);
  const Eigen::VectorXd distances =
      (positions.rowwise() - fit.head<3>().transpose()).rowwise().norm();
  return distances.maxCoeff() - distances.minCoeff() < 1e-4 * distances.maxCoeff();
}

bool stays_near(const model::Schedule& target, double value) {
  const auto values = target.values();
  return std::all_of(values.begin(), values.end(),
                     [value](double v) { return std::abs(v - value) < 1e-3 * value; });
}

/// On a sphere the variations of volume and area, 1 and -kappa, are parallel: the two targets are
/// one. Where the start meets them the area is left free, with a warning. Where it does not, the run
/// takes the sphere to another shape first, if it may.
void untie_sphere(const config::RunConfig& config, Case& vesicle) {
  model::Targets& targets = vesicle.model.targets;
  const auto& [start, is_sphere] = vesicle.origin;
  const auto& volume = targets.of<model::Volume>();
  auto& area = targets.of<model::Area>();
  if (!volume || !area || !is_sphere) return;
  const bool is_met = stays_near(*volume, start.volume()) && stays_near(*area, start.area());
  if (!is_met && config.solver.mend_start) return;
  if (!is_met) {
    throw ConfigError(
        "constraints.volume and constraints.area: cannot be met from a sphere, which moves them "
        "only together: start from another shape, an ellipsoid for example, or set "
        "solver.mend_start = true");
  }
  area.reset();
  vesicle.warnings.emplace_back(
      "volume and area of a sphere are one constraint: constraints.area is left free");
}

model::Measures measures_of(const problem::State& state) {
  return measure::measure({{}, state.is_two_phase(), {}}, state).measures;
}

/// Material and targets as given; a phase target that needs the phase field stays absent before
/// there is one.
model::Model given_model(const config::RunConfig& config, const model::Measures& start) {
  model::Model model;
  model.is_two_phase = config.phase.has_value();
  model.targets = model::make_targets(config.constraints, start, model.is_two_phase);
  const auto& area = model.targets.of<model::Area>();
  model.material = model::resolved_material(config.material, area ? area->value(0) : start.area());
  return model;
}

/// A minimiser knows no time.
model::Model model_of(const config::RunConfig& config, const model::Measures& start) {
  model::Model model = given_model(config, start);
  return config.solver.method == solve::Method::minimize
             ? model.frozen(std::numeric_limits<double>::infinity())
             : model;
}

void warn_of_schedules(const config::RunConfig& config, Case& vesicle) {
  if (config.solver.method != solve::Method::minimize) return;
  const model::Model given = given_model(config, vesicle.origin.measures);
  for (const auto& [table, key, schedule] : model::schedules_of(given)) {
    if (schedule.is_constant()) continue;
    vesicle.warnings.push_back(fmt::format(
        "{}.{} = {}: solver.method = \"minimize\" knows no time and takes the last value "
        "{:g}",
        table, key, text_of(schedule), schedule.last()));
  }
}

phase::PhaseStart phase_of(const config::RunConfig& config, const shapes::Shape& shape,
                           const model::Model& model) {
  const auto& target = model.targets.of<model::PhaseDifference>();
  return phase::start_phase(*config.phase, shape.surface, model.material.interface_width.value(0),
                            target ? std::optional(target->value(0)) : std::nullopt, shape.fields);
}

void check_topology(const config::RunConfig& config, const mesh::Triangulation& triangulation) {
  const int pieces = triangulation.num_components();
  if (pieces != 1) {
    throw ConfigError(
        fmt::format("shape.path = \"{}\": the surface has {} pieces: must be one vesicle "
                    "(shape.repair = true keeps the largest)",
                    config.shape.path, pieces));
  }
  const int genus = triangulation.genus();
  if (config.adaption.enabled && config.adaption.method == relax::MeshMethod::conformal &&
      genus != 0) {
    throw ConfigError(fmt::format(
        "adaption.method = \"conformal\": the surface has genus {}: must be 0; take \"local\" or "
        "\"bisection\"",
        genus));
  }
}

void check_files(const config::RunConfig& config) {
  if (config.shape.kind == shapes::ShapeKind::file) check_file(config, config.shape.path);
  if (config.phase && config.phase->kind == phase::PhaseKind::file)
    check_file(config, config.phase->path);
}

}  // namespace

Case case_of(const config::RunConfig& config, problem::State start,
             const std::optional<Origin>& origin) {
  check_topology(config, *start.triangulation);
  Case vesicle;
  vesicle.origin = origin ? *origin : Origin{measures_of(start), is_sphere(start.values.positions)};
  vesicle.model = model_of(config, vesicle.origin.measures);
  vesicle.start = std::move(start);
  vesicle.warnings = warnings_of(config, vesicle);
  warn_of_schedules(config, vesicle);
  untie_sphere(config, vesicle);
  return vesicle;
}

Case make_case(const config::RunConfig& config) {
  check_files(config);
  std::vector<std::string> notes = config.notes;
  const auto add_notes = [&](const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  };
  const shapes::Shape shape = shapes::start_shape(config.shape);
  add_notes(shape.notes);
  problem::State start = state_at_rest(shape.surface);
  if (config.phase) {
    phase::PhaseStart phase = phase_of(config, shape, model_of(config, measures_of(start)));
    add_order_parameter(start, std::move(phase.order_parameter));
    add_notes(phase.notes);
  }
  Case vesicle = case_of(config, std::move(start));
  vesicle.warnings.insert(vesicle.warnings.begin(), notes.begin(), notes.end());
  return vesicle;
}

}  // namespace vesica::setup
