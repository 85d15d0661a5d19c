#include "graph_equations.hpp"

#include "vesica/mesh/quality.hpp"
#include "vesica/mesh/redistribute.hpp"

namespace vesica::problem {

namespace {

constexpr double smallest_allowed_cosine = 0.85;

// A mesh is worn below this quality (3.5), when it has also lost this much since its last
// reference.
constexpr double worn_quality = 0.3;
constexpr double worn_fraction = 0.75;
constexpr int redistribution_sweeps = 10;

}  // namespace

Eigen::VectorXd border_residual(const model::Model& model, const NormalGraph& graph,
                                const EquationSettings& settings, const BorderArguments& at) {
  const bool is_original = settings.form == ConstraintForm::original;
  const auto active = model::active_constraints(model);
  const auto num_active = static_cast<Eigen::Index>(active.size());
  Eigen::VectorXd result(num_active + num_rigid);
  for (Eigen::Index k = 0; k < num_active; ++k) {
    const auto which = static_cast<std::size_t>(active[static_cast<std::size_t>(k)]);
    const auto& target = *model.targets[which];
    const double error = at.constraints.values[which] - target.value(at.time);
    double rate = at.constraints.positions[which].cwiseProduct(at.rates.velocity).sum();
    if (model.is_two_phase)
      rate += at.constraints.order_parameter[which].dot(at.rates.order_parameter);
    result[k] =
        is_original ? error : rate - target.rate(at.time) + settings.constraint_rate * error;
  }
  for (Eigen::Index k = 0; k < num_rigid; ++k) {
    const auto column = graph.gauge.col(k);
    const double error = column.dot(at.displacements);
    const double equation =
        is_original ? error : column.dot(at.speeds) + settings.constraint_rate * error;
    result[num_active + k] = column.isZero(0) ? at.gauge[k] : equation;
  }
  return result;
}

std::optional<RenewedGraph> renewed(const std::shared_ptr<const mesh::Triangulation>& triangulation,
                                    const NormalGraph& graph, const Eigen::VectorXd& displacements,
                                    double quality_of_reference, const Eigen::MatrixXd& nodal) {
  mesh::Positions positions = graph.positions(displacements);
  const double quality = mesh::quality(*triangulation, positions);
  const bool is_worn = quality < worn_quality && quality < worn_fraction * quality_of_reference;
  if (!is_worn && graph.smallest_cosine(*triangulation, displacements) >= smallest_allowed_cosine)
    return std::nullopt;
  RenewedGraph result;
  result.nodal = nodal;
  if (is_worn) {
    const auto moved = mesh::redistribute({triangulation, positions}, redistribution_sweeps);
    result.nodal = mesh::interpolate(*triangulation, moved.origins, nodal);
    positions = moved.positions;
  }
  result.graph = make_normal_graph(*triangulation, positions);
  result.quality = mesh::quality(*triangulation, positions);
  return result;
}

}  // namespace vesica::problem
