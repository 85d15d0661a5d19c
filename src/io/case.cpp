#include "vesica/io/case.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/model/make_model.hpp"
#include "vesica/problem/diagnostics.hpp"

namespace vesica::io {
namespace {

problem::Fields zero_fields(Eigen::Index num_nodes) {
  problem::Fields fields;
  fields.positions = mesh::Positions::Zero(num_nodes, 3);
  fields.mean_curvature = Eigen::VectorXd::Zero(num_nodes);
  return fields;
}

problem::State state_at_rest(const mesh::Surface& surface) {
  problem::State state;
  state.triangulation = surface.triangulation;
  state.values = zero_fields(surface.positions.rows());
  state.rates = state.values;
  state.values.positions = surface.positions;
  return state;
}

void add_order_parameter(problem::State& state, Eigen::VectorXd order_parameter) {
  state.rates.order_parameter = Eigen::VectorXd::Zero(order_parameter.size());
  state.values.order_parameter = std::move(order_parameter);
}

std::vector<std::string> warnings_of(const model::Model& model, const mesh::Surface& surface) {
  std::vector<std::string> warnings;
  if (!model.is_two_phase) return warnings;
  const model::MaterialOptions& material = model.material;
  const double edge = mesh::longest_edge(*surface.triangulation, surface.positions);
  if (edge > material.interface_width) {
    warnings.push_back(
        fmt::format("the mesh does not resolve the phase interface: longest edge {:.4g} > "
                    "material.interface_width = {:.4g}",
                    edge, material.interface_width));
  }
  const double contrast = std::abs(material.gaussian_rigidity.difference());
  const double rigidity =
      std::min(material.bending_rigidity.phase_1, material.bending_rigidity.phase_2);
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
  const Eigen::Vector4d fit = matrix.colPivHouseholderQr().solve(squares);
  const Eigen::VectorXd distances =
      (positions.rowwise() - fit.head<3>().transpose()).rowwise().norm();
  return distances.maxCoeff() - distances.minCoeff() < 1e-4 * distances.maxCoeff();
}

bool stays_near(const model::Ramp& target, double value) {
  return std::max(std::abs(target.from - value), std::abs(target.to - value)) < 1e-3 * value;
}

/// On a sphere the variations of volume and area, 1 and -kappa, are parallel: the two targets are
/// one. Where the start meets them the area is left free, with a warning; no flow could change one
/// of them alone.
void untie_sphere(Case& vesicle, const model::Measures& start) {
  model::Targets& targets = vesicle.model.targets;
  if (!targets.volume || !targets.area || !is_sphere(vesicle.start.values.positions)) return;
  if (!stays_near(*targets.volume, start.volume) || !stays_near(*targets.area, start.area)) {
    throw ConfigError(
        "constraints.volume and constraints.area: cannot be met from a sphere, which moves them "
        "only together: start from another shape, an ellipsoid for example");
  }
  targets.area.reset();
  vesicle.warnings.emplace_back(
      "volume and area of a sphere are one constraint: constraints.area is left free");
}

}  // namespace

Case make_case(const RunConfig& config) {
  const mesh::Surface surface = mesh::make_shape(config.shape);
  Case vesicle;
  vesicle.start = state_at_rest(surface);
  const problem::Diagnostics measured =
      problem::measure({config.material, false, {}}, vesicle.start);
  model::Measures measures{measured.volume, measured.area, std::nullopt};

  vesicle.model.is_two_phase = config.phase.has_value();
  model::Targets targets =
      model::make_targets(config.constraints, measures, vesicle.model.is_two_phase);
  const double area = targets.area ? targets.area->value(0) : measures.area;
  vesicle.model.material = model::resolved_material(config.material, area);
  if (config.phase) {
    const std::optional<double> phase_target =
        targets.phase_difference ? std::optional(targets.phase_difference->value(0)) : std::nullopt;
    add_order_parameter(vesicle.start, problem::initial_phase(
                                           *config.phase, surface,
                                           vesicle.model.material.interface_width, phase_target));
    measures.phase_difference = problem::measure(vesicle.model, vesicle.start).phase_difference;
    targets = model::make_targets(config.constraints, measures, true);
  }
  vesicle.model.targets = targets;
  vesicle.warnings = warnings_of(vesicle.model, surface);
  untie_sphere(vesicle, measures);
  return vesicle;
}

}  // namespace vesica::io
