#include "reduced_problem.hpp"

#include <utility>

#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

// Relative residuals of p, which decides how far the residual of the flow can fall, and of its
// change in a product, where Newton's method asks for little.
constexpr double moment_tolerance = 1e-9;
constexpr double moment_change_tolerance = 1e-6;

}  // namespace

ReducedProblem::ReducedProblem(std::shared_ptr<const mesh::Triangulation> triangulation,
                               model::Model model, const mesh::Positions& positions, int threads)
    : triangulation_(std::move(triangulation)),
      energy_(triangulation_, std::move(model), threads),
      graph_(make_normal_graph(*triangulation_, positions)),
      quality_of_reference_(mesh::quality(*triangulation_, positions)),
      active_(model::active_constraints(energy_.model())),
      threads_(resolved_threads(threads)) {}

Eigen::Index ReducedProblem::num_multipliers() const {
  return static_cast<Eigen::Index>(active_.size()) + num_rigid;
}

Multipliers ReducedProblem::multipliers(const Eigen::VectorXd& y) const {
  Multipliers result{};
  for (std::size_t k = 0; k < active_.size(); ++k)
    result[at(active_[k])] = y[num_nodal() + static_cast<Eigen::Index>(k)];
  return result;
}

Eigen::VectorXd ReducedProblem::order_parameter(const Eigen::VectorXd& y) const {
  if (!model().is_two_phase) return {};
  return y.segment(num_nodes(), num_nodes());
}

EnergyRates ReducedProblem::energy_rates(const Eigen::VectorXd& y_rate) const {
  return {y_rate.head(num_nodes()).asDiagonal() * graph_.directions, order_parameter(y_rate)};
}

Eigen::VectorXd ReducedProblem::initial_values(const State& start) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  y.head(num_nodes()) = along(start.values.positions - graph_.reference, graph_.directions);
  if (model().is_two_phase) y.segment(num_nodes(), num_nodes()) = start.values.order_parameter;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    y[num_nodal() + static_cast<Eigen::Index>(k)] =
        start.values.multipliers[at(active_[k])].value_or(0.0);
  }
  return y;
}

Unknowns ReducedProblem::unknowns(const State& state) const {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(size());
  rates.head(num_nodes()) = along(state.rates.positions, graph_.directions);
  if (model().is_two_phase) rates.segment(num_nodes(), num_nodes()) = state.rates.order_parameter;
  return {initial_values(state), rates};
}

ReducedPoint ReducedProblem::point(double time, const Eigen::VectorXd& y,
                                   const mesh::Positions& moment) const {
  ReducedPoint point;
  point.time = time;
  point.y = y;
  auto& fields = point.fields;
  fields.time = time;
  fields.positions = graph_.positions(y.head(num_nodes()));
  fields.order_parameter = order_parameter(y);
  auto equations = energy_.moment_equations(fields);
  fields.moment =
      fem::solve_mass_matrix(equations.mass, equations.rhs, threads_, moment, moment_tolerance);
  point.mass = std::move(equations.mass);
  point.constraints = energy_.constraints(fields.positions, fields.order_parameter);
  return point;
}

Fields ReducedProblem::values(const ReducedPoint& point) const {
  Fields result;
  result.positions = point.fields.positions;
  result.order_parameter = point.fields.order_parameter;
  result.mean_curvature = energy_.mean_curvature(point.fields);
  const auto weights = multipliers(point.y);
  for (const int k : active_) result.multipliers[at(k)] = weights[at(k)];
  return result;
}

Fields ReducedProblem::rates(const Eigen::VectorXd&, const Eigen::VectorXd& y_rate) const {
  const auto rates = energy_rates(y_rate);
  Fields result;
  result.positions = rates.velocity;
  result.mean_curvature = Eigen::VectorXd::Zero(num_nodes());
  result.order_parameter = rates.order_parameter;
  return result;
}

Eigen::VectorXd ReducedProblem::differential_mask() const {
  Eigen::VectorXd mask = Eigen::VectorXd::Zero(size());
  mask.head(num_nodal()).setOnes();
  return mask;
}

Eigen::VectorXd ReducedProblem::units(const Scales& scales) const {
  Eigen::VectorXd units = Eigen::VectorXd::Ones(size());
  units.head(num_nodes()).setConstant(scales.length);
  units.tail(num_multipliers()).setConstant(scales.multiplier());
  return units;
}

Eigen::VectorXd ReducedProblem::residual(const EquationSettings& settings,
                                         const ReducedPoint& point,
                                         const Eigen::VectorXd& y_rate) const {
  const auto n = num_nodes();
  const auto rates = energy_rates(y_rate);
  const Eigen::VectorXd mu = point.y.tail<num_rigid>();
  const auto gradient = energy_.gradient(point.fields, multipliers(point.y), rates);
  Eigen::VectorXd result(size());
  result.head(n) = along(gradient.positions, graph_.directions) + graph_.gauge * mu;
  if (model().is_two_phase) result.segment(n, n) = gradient.order_parameter;
  result.tail(num_multipliers()) =
      border_residual(model(), graph_, settings,
                      {point.time, point.constraints, rates, point.y.head(n), y_rate.head(n), mu});
  if (!result.allFinite()) throw RecoverableError("the residual of the flow is not finite");
  return result;
}

/// Gradients of the active constraints, or their rates, as columns over the unknowns of the nodes.
Eigen::MatrixXd ReducedProblem::constraint_columns(const ConstraintEvaluation& constraints) const {
  const auto n = num_nodes();
  Eigen::MatrixXd columns(num_nodal(), static_cast<Eigen::Index>(active_.size()));
  for (std::size_t k = 0; k < active_.size(); ++k) {
    auto column = columns.col(static_cast<Eigen::Index>(k));
    column.head(n) = along(constraints.positions[at(active_[k])], graph_.directions);
    if (model().is_two_phase) column.tail(n) = constraints.order_parameter[at(active_[k])];
  }
  return columns;
}

ReducedLinearisation ReducedProblem::linearise(const EquationSettings& settings,
                                               const ReducedPoint& point,
                                               const Eigen::VectorXd& y_rate) const {
  ReducedLinearisation there{settings, energy_rates(y_rate), {}, {}};
  there.columns = Eigen::MatrixXd::Zero(num_nodal(), num_multipliers());
  there.columns.leftCols(num_multipliers() - num_rigid) = constraint_columns(point.constraints);
  there.columns.rightCols<num_rigid>().topRows(num_nodes()) = graph_.gauge;
  if (settings.form == ConstraintForm::differentiated) {
    there.changes = constraint_columns(energy_.constraint_rates(
        point.fields.positions, point.fields.order_parameter, there.rates));
  }
  return there;
}

Eigen::MatrixXd ReducedProblem::border_rows(const ReducedLinearisation& there,
                                            const JacobianWeights& weights) const {
  Eigen::MatrixXd rows = border_row_factor(there.settings, weights) * there.columns.transpose();
  rows.topRows(there.changes.cols()) += weights.value * there.changes.transpose();
  return rows;
}

Eigen::VectorXd ReducedProblem::product(const ReducedPoint& point,
                                        const ReducedLinearisation& there,
                                        const JacobianWeights& weights,
                                        const Eigen::VectorXd& v) const {
  const auto n = num_nodes();
  const auto m = num_multipliers();
  const auto moved = energy_rates(v);  // along v, as a rate
  const EnergyRates rate_change{weights.rate * moved.velocity,
                                weights.rate * moved.order_parameter};
  EnergyFields change{weights.value * moved.velocity, {}, weights.value * moved.order_parameter};
  change.moment = fem::solve_mass_matrix(point.mass, energy_.moment_change(point.fields, change),
                                         threads_, {}, moment_change_tolerance);
  const auto gradient =
      energy_.gradient_change(point.fields, multipliers(point.y), there.rates, change, rate_change);
  Eigen::VectorXd result(size());
  result.head(n) = along(gradient.positions, graph_.directions);
  if (model().is_two_phase) result.segment(n, n) = gradient.order_parameter;
  result.head(num_nodal()) += there.columns * v.tail(m);
  auto border = result.tail(m);
  border = border_row_factor(there.settings, weights) *
           (there.columns.transpose() * v.head(num_nodal()));
  if (there.changes.cols() > 0) {
    border.head(there.changes.cols()) +=
        weights.value * (there.changes.transpose() * v.head(num_nodal()));
  }
  for (Eigen::Index k = m - num_rigid; k < m; ++k) {
    if (there.columns.col(k).isZero(0)) border[k] = v[num_nodal() + k];
  }
  return result;
}

bool ReducedProblem::renew_coordinates(Eigen::VectorXd& y, Eigen::VectorXd& y_rate) {
  const auto n = num_nodes();
  const auto rates = energy_rates(y_rate);
  Eigen::MatrixXd nodal(n, model().is_two_phase ? 5 : 3);
  nodal.leftCols<3>() = rates.velocity;
  if (model().is_two_phase) nodal.rightCols<2>() << order_parameter(y), rates.order_parameter;
  auto renewal = renewed(triangulation_, graph_, y.head(n), quality_of_reference_, nodal);
  if (!renewal) return false;
  graph_ = std::move(renewal->graph);
  quality_of_reference_ = renewal->quality;
  y.head(n).setZero();
  y_rate.head(n) = along(renewal->nodal.leftCols<3>(), graph_.directions);
  if (model().is_two_phase) {
    y.segment(n, n) = renewal->nodal.col(3);
    y_rate.segment(n, n) = renewal->nodal.col(4);
  }
  y.tail<num_rigid>().setZero();
  return true;
}

}  // namespace vesica::problem
