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

/// Calls visit.operator()<Constraint>() for the constraint at a place of the list.
template <class Visit>
void with_constraint(std::size_t place, const Visit& visit) {
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t candidate) {
    if (candidate == place) visit.template operator()<Constraint>();
  });
}

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
  for (const int place : model::active_constraints(model)) {
    const auto i = static_cast<std::size_t>(place);
    active_.push_back(i);
  }
  targets_.resize(size());
  units_.resize(size());
  for (Eigen::Index k = 0; k < size(); ++k) {
    const auto place = active_[static_cast<std::size_t>(k)];
    targets_[k] = model.targets[place]->last();
    with_constraint(place, [&]<class Constraint>() {
      units_[k] = std::pow(scales.length, Constraint::length_power);
    });
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
  const double area = evaluation.values[model::place_of<model::Constraints, model::Area>];
  for (Eigen::Index k = 0; k < size(); ++k) {
    with_constraint(active_[static_cast<std::size_t>(k)], [&]<class Constraint>() {
      relative[k] /= model::error_scale<Constraint>(targets_[k], area);
    });
  }
  return relative;
}

double ConstraintSet::largest_error(const problem::ConstraintEvaluation& evaluation) const {
  return size() == 0 ? 0.0 : relative_errors(evaluation).maxCoeff();
}

std::string ConstraintSet::worst_name(const problem::ConstraintEvaluation& evaluation) const {
  Eigen::Index worst = 0;
  relative_errors(evaluation).maxCoeff(&worst);
  std::string name;
  with_constraint(active_[static_cast<std::size_t>(worst)],
                  [&]<class Constraint>() { name = Constraint::key; });
  return name;
}

Eigen::MatrixXd ConstraintSet::gradients(const problem::NormalGraph& graph,
                                         const problem::ConstraintEvaluation& evaluation,
                                         bool is_two_phase) const {
  const auto n = graph.reference.rows();
  Eigen::MatrixXd result(is_two_phase ? 2 * n : n, size());
  for (Eigen::Index k = 0; k < size(); ++k) {
    const auto i = active_[static_cast<std::size_t>(k)];
    result.col(k) =
        along_graph(graph, evaluation.positions[i], evaluation.order_parameter[i], is_two_phase);
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
  model::PerConstraint values;
  for (Eigen::Index k = 0; k < size(); ++k)
    values[active_[static_cast<std::size_t>(k)]] = multipliers[k];
  return values;
}

problem::Multipliers ConstraintSet::all(const Eigen::VectorXd& multipliers) const {
  problem::Multipliers values{};
  for (Eigen::Index k = 0; k < size(); ++k)
    values[active_[static_cast<std::size_t>(k)]] = multipliers[k];
  return values;
}

}  // namespace vesica::minimise
