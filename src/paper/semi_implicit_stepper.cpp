#include "semi_implicit_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"
#include "vesica/linalg/dense.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::paper {

namespace {

constexpr double constraint_tolerance = 1e-8;
constexpr int max_quasi_newton_iterations = 50;
constexpr double initial_damping = 1e-4;  // alpha^0 of 3.4 [R_c^2/k]

double resolved_time_step(const solve::SolverOptions& options, const model::Model& model) {
  if (!options.time_step.value && !model.is_two_phase) {
    throw ConfigError(
        fmt::format("solver.time_step = \"{}\": a single-phase vesicle has no interface width, "
                    "give a number",
                    solve::TimeStep::from_interface_width));
  }
  const auto widths = model.material.interface_width.values();
  const double tau = options.time_step.resolved(*std::min_element(widths.begin(), widths.end()));
  if (!(tau > 0) || !std::isfinite(tau))
    throw ConfigError(fmt::format("solver.time_step = {}: must be > 0", tau));
  return tau;
}

/// The fields that Problem 3.2 starts with.
problem::State prepared(problem::State start, const SemiImplicitProblem& problem) {
  auto& values = start.values;
  try {
    const auto q = problem.shape_operator(values.positions);
    values.mean_curvature = -(q.col(0) + q.col(1) + q.col(2));
  } catch (const RecoverableError& trouble) {
    throw SolverError(fmt::format("initial values: {}", trouble.what()));
  }
  const auto& layout = problem.layout();
  for (int i = 0; i < model::num_constraints; ++i) {
    auto& multiplier = values.multipliers[static_cast<std::size_t>(i)];
    multiplier = layout.multiplier(i) >= 0 ? std::optional(multiplier.value_or(0)) : std::nullopt;
  }
  start.rates = values;
  start.rates.positions.setZero();
  start.rates.mean_curvature.setZero();
  start.rates.order_parameter.setZero();
  start.rates.multipliers = {};
  if (!(start.damping > 0))
    start.damping = initial_damping * problem::scales_of(problem.model(), start).damping();
  return start;
}

Eigen::VectorXd active_multipliers(const problem::DofLayout& layout,
                                   const model::PerConstraint& values) {
  Eigen::VectorXd active(layout.num_multipliers());
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout.multiplier(i) >= 0)
      active[layout.multiplier(i)] = values[static_cast<std::size_t>(i)].value_or(0);
  }
  return active;
}

/// Solutions for all columns of `sides`; a column of zeros is its own solution.
Eigen::MatrixXd solve_columns(const linalg::DirectSolver& solver, const Eigen::MatrixXd& sides) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(sides.rows(), sides.cols());
  const auto n = static_cast<std::size_t>(sides.rows());
  for (Eigen::Index k = 0; k < sides.cols(); ++k) {
    if (sides.col(k).isZero(0)) continue;
    solver.solve({sides.col(k).data(), n}, {result.col(k).data(), n});
  }
  if (!result.allFinite()) throw RecoverableError("the linear system (A.1) is singular");
  return result;
}

problem::Fields rates_between(const problem::Fields& from, const problem::Fields& to, double tau) {
  problem::Fields rates;
  rates.positions = (to.positions - from.positions) / tau;
  rates.mean_curvature = (to.mean_curvature - from.mean_curvature) / tau;
  rates.order_parameter = (to.order_parameter - from.order_parameter) / tau;
  return rates;
}

}  // namespace

SemiImplicitStepper::SemiImplicitStepper(const solve::SolverOptions& options,
                                         const model::Model& model, problem::State start)
    : problem_(start.triangulation, model,
               options.tangential_fields ? paper::TangentialVelocity::fields
                                         : paper::TangentialVelocity::eliminated,
               options.threads),
      time_step_(resolved_time_step(options, model)),
      system_(problem_.make_system()),
      geometry_solver_(linalg::make_direct_solver(options.direct_solver(), system_.geometry,
                                                  problem_.block_size())) {
  state_ = prepared(std::move(start), problem_);
  if (model.is_two_phase)
    phase_solver_ = linalg::make_direct_solver(options.direct_solver(), system_.phase, 1);
}

solve::StepReport SemiImplicitStepper::step(double end_time) {
  std::string trouble;
  {
    const ScopedTimer timer(seconds_.total);
    trouble = try_step(end_time);
  }
  const auto status = trouble.empty() ? solve::StepStatus::accepted : solve::StepStatus::failed;
  return report(status, std::move(trouble));
}

std::string SemiImplicitStepper::try_step(double end_time) {
  const double remaining = end_time - state_.time;
  const bool is_last = remaining <= time_step_ * (1 + 1e-6);
  const double tau = is_last ? remaining : time_step_;
  const double time = is_last ? end_time : state_.time + tau;
  try {
    accept(advance(tau, time), tau, time);
  } catch (const RecoverableError& trouble) {
    ++counts_.failures;
    return fmt::format(
        "semi-implicit step {} at t = {:.6g}, tau = {:.2g}: {}; a smaller solver.time_step or a "
        "finer mesh may help",
        counts_.steps + 1, state_.time, tau, trouble.what());
  }
  return {};
}

problem::Fields SemiImplicitStepper::advance(double tau, double time) {
  fem::NodalShapeOperator shape_operator;
  {
    const ScopedTimer timer(seconds_.residual);
    shape_operator = problem_.shape_operator(state_.values.positions);
  }
  {
    const ScopedTimer timer(seconds_.jacobian);
    ++counts_.jacobians;
    problem_.assemble({tau, state_.damping, time}, state_.values, shape_operator, system_);
  }
  return meet_constraints(solve_system(), time);
}

SemiImplicitSolution SemiImplicitStepper::solve_system() {
  {
    const ScopedTimer timer(seconds_.factorisation);
    ++counts_.factorisations;
    geometry_solver_->factorise(system_.geometry);
    if (phase_solver_) phase_solver_->factorise(system_.phase);
  }
  const ScopedTimer timer(seconds_.solve);
  SemiImplicitSolution solution;
  solution.geometry = solve_columns(*geometry_solver_, system_.geometry_sides);
  if (phase_solver_) solution.phase = solve_columns(*phase_solver_, system_.phase_sides);
  return solution;
}

/// Quasi-Newton iteration (B.1), from the multipliers of the last step.
problem::Fields SemiImplicitStepper::meet_constraints(const SemiImplicitSolution& solution,
                                                      double time) {
  const ScopedTimer timer(seconds_.residual);
  Eigen::VectorXd multipliers = active_multipliers(problem_.layout(), state_.values.multipliers);
  const Eigen::VectorXd scales = problem_.constraint_scales(state_.values, time);
  for (int iteration = 0; iteration <= max_quasi_newton_iterations; ++iteration) {
    problem::Fields trial = problem_.fields_at(solution, multipliers);
    const Eigen::VectorXd errors = problem_.constraint_errors(trial, time);
    ++counts_.residuals;
    if (!errors.allFinite()) break;
    if ((errors.array().abs() < constraint_tolerance * scales.array()).all()) return trial;
    ++counts_.newton;
    linalg::DenseLu slopes;
    if (!slopes.factorise(problem_.constraint_slopes(trial, solution))) break;
    multipliers -= slopes.solve(errors);
  }
  throw RecoverableError("the quasi-Newton iteration for the multipliers does not converge");
}

void SemiImplicitStepper::accept(problem::Fields next, double tau, double time) {
  state_.rates = rates_between(state_.values, next, tau);
  state_.values = std::move(next);
  state_.time = time;
  last_step_ = tau;
  ++counts_.steps;
}

solve::StepReport SemiImplicitStepper::report(solve::StepStatus status, std::string reason) const {
  solve::StepReport result;
  result.status = status;
  result.time = state_.time;
  result.step_size = last_step_;
  result.order = 1;
  result.counts = counts_;
  result.seconds = seconds_;
  result.reason = std::move(reason);
  return result;
}

}  // namespace vesica::paper
