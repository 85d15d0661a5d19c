#include "vesica/problem/variational_problem.hpp"

#include <utility>

#include "graph_equations.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }
constexpr Eigen::Index displacement = 3;
constexpr Eigen::Index phase = 4;

}  // namespace

VariationalProblem::VariationalProblem(std::shared_ptr<const mesh::Triangulation> triangulation,
                                       model::Model model, const mesh::Positions& positions,
                                       int threads)
    : shared_triangulation_(std::move(triangulation)),
      energy_(shared_triangulation_, std::move(model), threads),
      graph_(make_normal_graph(*shared_triangulation_, positions)),
      quality_of_reference_(mesh::quality(*shared_triangulation_, positions)),
      active_(model::active_constraints(energy_.model())) {}

Eigen::Index VariationalProblem::num_nodal() const {
  return graph_.reference.rows() * block_size();
}

Eigen::Index VariationalProblem::num_multipliers() const {
  return static_cast<Eigen::Index>(active_.size()) + num_rigid;
}

Eigen::VectorXd VariationalProblem::component(const Eigen::VectorXd& y,
                                              Eigen::Index component) const {
  const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>> strided(
      y.data() + component, graph_.reference.rows(), Eigen::InnerStride<>(block_size()));
  return strided;
}

Eigen::VectorXd VariationalProblem::displacements(const Eigen::VectorXd& y) const {
  return component(y, displacement);
}

EnergyFields VariationalProblem::fields(double time, const Eigen::VectorXd& y) const {
  EnergyFields fields;
  fields.time = time;
  fields.positions = graph_.positions(displacements(y));
  fields.moment.resize(graph_.reference.rows(), 3);
  for (Eigen::Index k = 0; k < 3; ++k) fields.moment.col(k) = component(y, k);
  if (model().is_two_phase) fields.order_parameter = component(y, phase);
  return fields;
}

EnergyRates VariationalProblem::energy_rates(const Eigen::VectorXd& y_rate) const {
  EnergyRates rates;
  rates.velocity = displacements(y_rate).asDiagonal() * graph_.directions;
  if (model().is_two_phase) rates.order_parameter = component(y_rate, phase);
  return rates;
}

Multipliers VariationalProblem::multipliers(const Eigen::VectorXd& y) const {
  Multipliers result{};
  for (std::size_t k = 0; k < active_.size(); ++k)
    result[at(active_[k])] = y[num_nodal() + static_cast<Eigen::Index>(k)];
  return result;
}

Eigen::VectorXd VariationalProblem::initial_values(const State& start) const {
  const auto block = block_size();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const auto moment =
      energy_.moment(start.values.positions, start.values.order_parameter, start.time);
  const mesh::Positions moved = start.values.positions - graph_.reference;
  for (Eigen::Index i = 0; i < moment.rows(); ++i) {
    y.segment<3>(i * block) = moment.row(i).transpose();
    y[i * block + displacement] = moved.row(i).dot(graph_.directions.row(i));
    if (block == 5) y[i * block + phase] = start.values.order_parameter[i];
  }
  const auto& values = start.values.multipliers;
  for (std::size_t k = 0; k < active_.size(); ++k)
    y[num_nodal() + static_cast<Eigen::Index>(k)] = values[at(active_[k])].value_or(0.0);
  return y;
}

Unknowns VariationalProblem::unknowns(const State& state) const {
  const auto block = block_size();
  const Eigen::VectorXd speeds = along(state.rates.positions, graph_.directions);
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(size());
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    rates[i * block + displacement] = speeds[i];
    if (block == 5) rates[i * block + phase] = state.rates.order_parameter[i];
  }
  return {initial_values(state), rates};
}

/// kappa = kappa_s - p . nu / k_kappa.
Fields VariationalProblem::values(double time, const Eigen::VectorXd& y) const {
  const auto now = fields(time, y);
  Fields result;
  result.positions = now.positions;
  result.order_parameter = now.order_parameter;
  result.mean_curvature = energy_.mean_curvature(now);
  const auto weights = multipliers(y);
  for (const int k : active_) result.multipliers[at(k)] = weights[at(k)];
  return result;
}

Fields VariationalProblem::rates(const Eigen::VectorXd&, const Eigen::VectorXd& y_rate) const {
  const auto rates = energy_rates(y_rate);
  Fields result;
  result.positions = rates.velocity;
  result.mean_curvature = Eigen::VectorXd::Zero(rates.velocity.rows());
  result.order_parameter = rates.order_parameter;
  return result;
}

Eigen::VectorXd VariationalProblem::differential_mask() const {
  Eigen::VectorXd mask = Eigen::VectorXd::Zero(size());
  for (Eigen::Index row = 0; row < num_nodal(); ++row)
    mask[row] = row % block_size() >= displacement ? 1 : 0;
  return mask;
}

Eigen::VectorXd VariationalProblem::units(const Scales& scales) const {
  Eigen::VectorXd units(size());
  for (Eigen::Index row = 0; row < num_nodal(); ++row) {
    const auto component = row % block_size();
    units[row] = component < displacement    ? scales.energy / scales.length
                 : component == displacement ? scales.length
                                             : 1;
  }
  units.tail(num_multipliers()).setConstant(scales.multiplier());
  return units;
}

std::optional<model::EnergyParts> VariationalProblem::energy(double time,
                                                             const Eigen::VectorXd& y) const {
  auto now = fields(time, y);
  now.moment = energy_.moment(now.positions, now.order_parameter, time);
  return energy_.energy(now);
}

Eigen::VectorXd VariationalProblem::residual(const EquationSettings& settings, double time,
                                             const Eigen::VectorXd& y,
                                             const Eigen::VectorXd& y_rate) const {
  const auto block = block_size();
  const auto now = fields(time, y);
  const auto rates = energy_rates(y_rate);
  const auto gradient = energy_.gradient(now, multipliers(y), rates);
  const auto constraints = energy_.constraints(now.positions, now.order_parameter);
  const Eigen::VectorXd mu = y.tail<num_rigid>();
  const Eigen::VectorXd force = along(gradient.positions, graph_.directions) + graph_.gauge * mu;
  Eigen::VectorXd result(size());
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    result.segment<3>(i * block) = gradient.moment.row(i).transpose();
    result[i * block + displacement] = force[i];
    if (block == 5) result[i * block + phase] = gradient.order_parameter[i];
  }
  result.tail(num_multipliers()) =
      border_residual(model(), graph_, settings,
                      {time, constraints, rates, displacements(y), displacements(y_rate), mu});
  if (!result.allFinite()) throw RecoverableError("the residual of the flow is not finite");
  return result;
}

linalg::BorderedMatrix VariationalProblem::make_matrix() const {
  linalg::BorderedMatrix matrix;
  matrix.block = energy_.graph().block_pattern(block_size());
  matrix.columns = Eigen::MatrixXd::Zero(num_nodal(), num_multipliers());
  matrix.rows = Eigen::MatrixXd::Zero(num_multipliers(), num_nodal());
  matrix.corner = Eigen::MatrixXd::Zero(num_multipliers(), num_multipliers());
  return matrix;
}

/// Gradients of the active constraints, or their rates, as columns over the unknowns of the nodes.
Eigen::MatrixXd VariationalProblem::constraint_columns(
    const ConstraintEvaluation& constraints) const {
  const auto block = block_size();
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(num_nodal(), static_cast<Eigen::Index>(active_.size()));
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const auto& gradient = constraints.positions[at(active_[k])];
    auto column = columns.col(static_cast<Eigen::Index>(k));
    for (Eigen::Index i = 0; i < gradient.rows(); ++i) {
      column[i * block + displacement] = gradient.row(i).dot(graph_.directions.row(i));
      if (block == 5) column[i * block + phase] = constraints.order_parameter[at(active_[k])][i];
    }
  }
  return columns;
}

void VariationalProblem::jacobian(const EquationSettings& settings, const JacobianWeights& weights,
                                  double time, const Eigen::VectorXd& y,
                                  const Eigen::VectorXd& y_rate,
                                  linalg::BorderedMatrix& matrix) const {
  const auto now = fields(time, y);
  const auto rates = energy_rates(y_rate);
  energy_.hessian(now, multipliers(y), rates, graph_.directions, weights, matrix.block);
  const bool is_original = settings.form == ConstraintForm::original;
  const double first = border_row_factor(settings, weights);
  const auto num_active = static_cast<Eigen::Index>(active_.size());
  const auto gradients =
      constraint_columns(energy_.constraints(now.positions, now.order_parameter));
  matrix.columns.setZero();
  matrix.rows.setZero();
  matrix.corner.setZero();
  matrix.columns.leftCols(num_active) = gradients;
  matrix.rows.topRows(num_active) = first * gradients.transpose();
  if (!is_original && weights.value != 0) {
    const auto changes =
        constraint_columns(energy_.constraint_rates(now.positions, now.order_parameter, rates));
    matrix.rows.topRows(num_active) += weights.value * changes.transpose();
  }
  for (Eigen::Index k = 0; k < num_rigid; ++k) {
    const auto column = graph_.gauge.col(k);
    if (column.isZero(0)) {
      matrix.corner(num_active + k, num_active + k) = 1;
      continue;
    }
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      const auto row = i * block_size() + displacement;
      matrix.columns(row, num_active + k) = column[i];
      matrix.rows(num_active + k, row) = first * column[i];
    }
  }
}

bool VariationalProblem::renew_coordinates(Eigen::VectorXd& y, Eigen::VectorXd& y_rate) {
  const Eigen::VectorXd d = displacements(y);
  Eigen::MatrixXd nodal(d.size(), 2 * block_size() + 3);
  nodal << as_rows(y), as_rows(y_rate), energy_rates(y_rate).velocity;
  auto renewal = renewed(shared_triangulation_, graph_, d, quality_of_reference_, nodal);
  if (!renewal) return false;
  graph_ = std::move(renewal->graph);
  quality_of_reference_ = renewal->quality;
  const auto block = block_size();
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    const auto row = renewal->nodal.row(i);
    y.segment(i * block, block) = row.head(block).transpose();
    y_rate.segment(i * block, block) = row.segment(block, block).transpose();
    y[i * block + displacement] = 0;
    y_rate[i * block + displacement] = row.tail<3>().dot(graph_.directions.row(i));
  }
  y.tail<num_rigid>().setZero();
  return true;
}

/// The unknowns of the nodes, a row a node.
Eigen::MatrixXd VariationalProblem::as_rows(const Eigen::VectorXd& y) const {
  return y.head(num_nodal()).reshaped(block_size(), graph_.reference.rows()).transpose();
}

}  // namespace vesica::problem
