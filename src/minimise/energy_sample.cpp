#include "energy_sample.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "vesica/core/error.hpp"

namespace vesica::minimise {

namespace {

constexpr std::array<std::string_view, 3> constraint_names{"volume", "area", "phase_difference"};
constexpr std::size_t phase = 2;

}  // namespace

EnergySample sample_energy(const problem::EnergyProblem& problem, const mesh::Positions& positions,
                           const Eigen::VectorXd& order_parameter) {
  EnergySample sample;
  sample.fields = problem.fields(positions, order_parameter);
  sample.energy = problem.energy(sample.fields);
  sample.gradient = problem.gradient(sample.fields, {});
  sample.constraints = problem.constraints(positions, order_parameter);
  return sample;
}

Eigen::VectorXd along_graph(const problem::NormalGraph& graph, const mesh::Positions& positions,
                            const Eigen::VectorXd& order_parameter, bool is_two_phase) {
  const auto n = positions.rows();
  Eigen::VectorXd result = Eigen::VectorXd::Zero(is_two_phase ? 2 * n : n);
  result.head(n) = positions.cwiseProduct(graph.directions).rowwise().sum();
  if (is_two_phase && order_parameter.size() > 0) result.tail(n) = order_parameter;
  return result;
}

mesh::Positions positions_of(const problem::NormalGraph& graph, const Eigen::VectorXd& unknowns) {
  return graph.positions(unknowns.head(graph.reference.rows()));
}

Eigen::VectorXd order_parameter_of(const problem::NormalGraph& graph,
                                   const Eigen::VectorXd& unknowns) {
  return unknowns.tail(unknowns.size() - graph.reference.rows());
}

ConstraintSet::ConstraintSet(const model::Model& model, const problem::Scales& scales) {
  for (const auto& [table, key, schedule] : model::schedules_of(model)) {
    if (schedule.is_constant()) continue;
    throw ConfigError(fmt::format("{}.{} = {}: must be constant for solver.method = minimize",
                                  table, key, text_of(schedule)));
  }
  const auto targets = model.targets.in_order();
  const double length = scales.length;
  const std::array<double, 3> units{length * length * length, length * length, length * length};
  for (const int place : model::active_constraints(model)) {
    const auto i = static_cast<std::size_t>(place);
    active_.push_back(i);
  }
  targets_.resize(size());
  units_.resize(size());
  for (Eigen::Index k = 0; k < size(); ++k) {
    targets_[k] = targets[active_[static_cast<std::size_t>(k)]]->last();
    units_[k] = units[active_[static_cast<std::size_t>(k)]];
  }
}

Eigen::VectorXd ConstraintSet::errors(const problem::ConstraintEvaluation& evaluation) const {
  Eigen::VectorXd errors = -targets_;
  for (Eigen::Index k = 0; k < size(); ++k)
    errors[k] += evaluation.values[active_[static_cast<std::size_t>(k)]];
  return errors;
}

Eigen::VectorXd ConstraintSet::relative_errors(
    const problem::ConstraintEvaluation& evaluation) const {
  Eigen::VectorXd relative = errors(evaluation).cwiseAbs();
  for (Eigen::Index k = 0; k < size(); ++k) {
    relative[k] /= active_[static_cast<std::size_t>(k)] == phase ? evaluation.values[1]
                                                                 : std::abs(targets_[k]);
  }
  return relative;
}

double ConstraintSet::largest_error(const problem::ConstraintEvaluation& evaluation) const {
  return size() == 0 ? 0.0 : relative_errors(evaluation).maxCoeff();
}

std::string ConstraintSet::worst_name(const problem::ConstraintEvaluation& evaluation) const {
  Eigen::Index worst = 0;
  relative_errors(evaluation).maxCoeff(&worst);
  return std::string(constraint_names[active_[static_cast<std::size_t>(worst)]]);
}

Eigen::MatrixXd ConstraintSet::gradients(const problem::NormalGraph& graph,
                                         const problem::ConstraintEvaluation& evaluation,
                                         bool is_two_phase) const {
  const auto n = graph.reference.rows();
  Eigen::MatrixXd result(is_two_phase ? 2 * n : n, size());
  for (Eigen::Index k = 0; k < size(); ++k) {
    const auto i = active_[static_cast<std::size_t>(k)];
    const Eigen::VectorXd none;
    result.col(k) = along_graph(graph, evaluation.positions[i],
                                i == phase ? evaluation.order_parameter : none, is_two_phase);
  }
  return result;
}

Eigen::VectorXd ConstraintSet::lagrangian_gradient(const problem::NormalGraph& graph,
                                                   const EnergySample& sample,
                                                   const Eigen::VectorXd& multipliers,
                                                   bool is_two_phase) const {
  return along_graph(graph, sample.gradient.positions, sample.gradient.order_parameter,
                     is_two_phase) +
         gradients(graph, sample.constraints, is_two_phase) * multipliers;
}

model::PerConstraint ConstraintSet::named(const Eigen::VectorXd& multipliers) const {
  std::array<std::optional<double>, model::num_constraints> values;
  for (Eigen::Index k = 0; k < size(); ++k)
    values[active_[static_cast<std::size_t>(k)]] = multipliers[k];
  return model::PerConstraint::from(values);
}

}  // namespace vesica::minimise
