#include "ceres_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::minimise {

namespace {

// Measured (docs/lab-notes/minimisation.md); lengths in R_c, energies in k_1.
constexpr double penalty = 1e3;  // rho at least
constexpr double penalty_per_multiplier = 40;
constexpr double penalty_factor = 3;  // when a constraint error does not fall
constexpr double largest_penalty_growth = 100;
constexpr double error_reduction = 0.5;
constexpr int inner_iterations = 15;
constexpr double inner_reduction = 0.1;     // of the distance to the minimum
constexpr double smallest_distance = 1e-7;  // rounding of the energy ends the line search there
constexpr double largest_move = 0.15;       // max|d| of an accepted point
constexpr double refused_move = 0.5;        // of a trial point
constexpr double smallest_cosine = 0.6;     // between a normal and that of the reference

constexpr double move_to_keep = 5e-3;
constexpr double move_to_release = 0.02;
constexpr double quality_to_release = 0.85;

constexpr double shorter_trial = 0.2;
constexpr int max_attempts = 4;
constexpr int max_stalls = 5;
constexpr double least_gain = 0.02;  // of half the squared distance to the minimum

}  // namespace

CeresStepper::CeresStepper(const solve::SolverOptions& options, const model::Model& model,
                           problem::State start, MeshKeeper keeper)
    : options_(options),
      state_(std::move(start)),
      scales_(problem::scales_of(model, state_)),
      problem_(state_.triangulation, model, options.threads),
      constraints_(model, scales_),
      metric_(problem_, scales_),
      mesh_care_(surface(state_.values.positions)),
      keeper_(keeper),
      first_time_(state_.time),
      newton_distance_(near_minimum) {
  const ScopedTimer timer(seconds_.total);
  try {
    sample_at(state_.values.positions, state_.values.order_parameter);
    renew_reference();
    next_multipliers_ = multipliers_;
  } catch (const RecoverableError& trouble) {
    throw SolverError(fmt::format(
        "start of the minimisation: {}; a finer or smoother start may help", trouble.what()));
  }
  store();
}

solve::StepReport CeresStepper::step(double) {
  std::string trouble;
  {
    const ScopedTimer timer(seconds_.total);
    trouble = try_step();
  }
  if (trouble.empty()) return report(solve::StepStatus::accepted, {});
  return report(solve::StepStatus::failed,
                fmt::format("minimisation, outer iteration {}: {}", counts_.steps + 1, trouble));
}

std::string CeresStepper::try_step() {
  std::string trouble;
  for (int attempt = 0; attempt < max_attempts && stalls_ < max_stalls; ++attempt) {
    try {
      if (is_reference_old_) renew_reference();
      if (try_newton()) return {};
      const InnerProblem inner = inner_problem();
      auto result = minimise(inner);
      trouble = objection(result);
      if (trouble.empty()) {
        accept(std::move(result), inner);
        return {};
      }
    } catch (const RecoverableError& error) {
      trouble = error.what();
    }
    retreat();
  }
  return stalls_ < max_stalls ? trouble : stall_text();
}

void CeresStepper::sample_at(const mesh::Positions& positions,
                             const Eigen::VectorXd& order_parameter) {
  const ScopedTimer timer(seconds_.residual);
  ++counts_.residuals;
  point_.sample = sample_energy(problem_, positions, order_parameter);
}

void CeresStepper::renew_reference() {
  const auto& fields = point_.sample.fields;
  graph_ = problem::make_normal_graph(problem_.triangulation(), fields.positions);
  {
    const ScopedTimer timer(seconds_.factorisation);
    ++counts_.jacobians;
    counts_.factorisations += is_two_phase() ? 3 : 2;
    metric_.factorise(fields.positions, fields.order_parameter);
  }
  point_.unknowns.setZero(metric_.size());
  point_.unknowns.tail(fields.order_parameter.size()) = fields.order_parameter;
  coordinates_.emplace(metric_, graph_);
  reference_quality_ = mesh::quality(problem_.triangulation(), fields.positions);
  is_reference_old_ = false;
  linearise();
}

void CeresStepper::linearise() {
  const ScopedTimer timer(seconds_.solve);
  const auto& sample = point_.sample;
  slopes_.energy = coordinates_->slope(along_graph(
      graph_, sample.gradient.positions, sample.gradient.order_parameter, is_two_phase()));
  const auto gradients = constraints_.gradients(graph_, sample.constraints, is_two_phase());
  slopes_.constraints.resize(metric_.size(), constraints_.size());
  for (Eigen::Index k = 0; k < constraints_.size(); ++k)
    slopes_.constraints.col(k) = coordinates_->slope(gradients.col(k));
  multipliers_ = slopes_.multipliers();
}

/// The constraints must be stiffer than the Lagrangian curves along them, which grows with the
/// multipliers.
Eigen::VectorXd CeresStepper::penalties() const {
  const double largest =
      constraints_.size() == 0
          ? 0
          : multipliers_.cwiseProduct(constraints_.units()).cwiseAbs().maxCoeff() / scales_.energy;
  const double reduced = penalty_growth_ * std::max(penalty, penalty_per_multiplier * largest);
  return reduced * scales_.energy * constraints_.units().cwiseAbs2().cwiseInverse();
}

InnerProblem CeresStepper::inner_problem() const {
  return {problem_,
          graph_,
          constraints_,
          *coordinates_,
          next_multipliers_,
          penalties(),
          refused_move * scales_.length,
          scales_.energy};
}

InnerResult CeresStepper::minimise(const InnerProblem& inner) {
  coordinates_->absorb(slopes_.constraints, inner.weights, trial_step_ * std::sqrt(scales_.energy));
  InnerLimits limits;
  limits.iterations = inner_iterations;
  limits.gradient = std::max(inner_reduction * distance(), smallest_distance) * trial_step_;
  limits.move = largest_move * scales_.length;
  auto result = minimise_inner(inner, point_, limits);
  counts_.newton += result.iterations;
  counts_.residuals += result.evaluations;
  counts_.failures += result.refusals;
  seconds_.residual += result.seconds.residual;
  seconds_.solve += result.seconds.solve;
  return result;
}

std::string CeresStepper::objection(const InnerResult& result) {
  const auto& positions = result.point.sample.fields.positions;
  const auto condition = mesh_condition(surface(positions));
  if (mesh_care_.is_degenerate(condition)) {
    return fmt::format(
        "the mesh degenerates ({}); a finer mesh, another start or solver.method = ida may help, "
        "or the shape pinches off",
        describe(condition));
  }
  if (graph_.smallest_cosine(problem_.triangulation(),
                             result.point.unknowns.head(positions.rows())) < smallest_cosine) {
    return "the surface turns away from its reference; a finer mesh may help";
  }
  const double gain = result.decrease;
  if (gain > 0 && gain > least_gain * 0.5 * distance() * distance()) {
    stalls_ = 0;
  } else {
    ++stalls_;
  }
  return gain > 0 ? "" : stall_text();
}

void CeresStepper::accept(InnerResult result, const InnerProblem& inner) {
  ++counts_.steps;
  const double error_before = constraints_.largest_error(point_.sample.constraints);
  point_ = std::move(result.point);
  trial_step_ =
      stalls_ > 0 ? trial_step_ * shorter_trial : std::min(1.0, trial_step_ / shorter_trial);
  linearise();
  const double move = move_of(point_.unknowns);
  const double quality = mesh::quality(problem_.triangulation(), point_.sample.fields.positions);
  keeps_reference_ = stalls_ == 0 && move < (keeps_reference_ ? move_to_release : move_to_keep) &&
                     quality > quality_to_release * reference_quality_;
  is_reference_old_ = !keeps_reference_;
  if (distance() > near_minimum || stalls_ > 0) {
    care_for_mesh();
    next_multipliers_ = multipliers_;
  } else {
    choose_multipliers(inner, error_before);
  }
  store();
}

/// Near the minimum: the update of the augmented Lagrangian, which converges for a penalty that is
/// large enough. Least squares, better far away, need not.
void CeresStepper::choose_multipliers(const InnerProblem& last, double error_before) {
  const auto& constraints = point_.sample.constraints;
  if (constraints_.largest_error(constraints) > error_reduction * error_before)
    penalty_growth_ = std::min(largest_penalty_growth, penalty_growth_ * penalty_factor);
  next_multipliers_ =
      last.multipliers + last.weights.cwiseProduct(constraints_.errors(constraints));
}

/// Moves the nodes along the surface when the mesh is worn. The state may change a little: the new
/// surface interpolates the old one.
void CeresStepper::care_for_mesh() {
  const auto& fields = point_.sample.fields;
  const auto before = mesh_condition(surface(fields.positions));
  if (keeper_ == MeshKeeper::caller || !mesh_care_.is_worn(before)) return;
  const auto moved = mesh_care_.redistribute(surface(fields.positions), fields.order_parameter);
  sample_at(moved.positions, moved.order_parameter);
  renew_reference();
}

/// After an inner minimisation that was thrown away: a new reference, a better mesh if there is
/// one, and shorter trial steps.
void CeresStepper::retreat() {
  ++counts_.failures;
  trial_step_ *= shorter_trial;
  keeps_reference_ = false;
  is_reference_old_ = true;
  try {
    care_for_mesh();
  } catch (const RecoverableError&) {
    const auto& values = state_.values;
    sample_at(values.positions, values.order_parameter);
  }
  next_multipliers_ = multipliers_;
}

void CeresStepper::store() {
  const auto& fields = point_.sample.fields;
  state_.time = first_time_ + static_cast<double>(counts_.steps);
  state_.damping = 0;
  state_.values = {fields.positions, problem_.mean_curvature(fields), fields.order_parameter,
                   constraints_.named(multipliers_)};
  const auto n = fields.positions.rows();
  const Eigen::VectorXd steepest = metric_.l2_gradient(
      constraints_.lagrangian_gradient(graph_, point_.sample, multipliers_, is_two_phase()));
  const auto material = problem_.model().material.at(0);
  state_.rates = {};
  state_.rates.positions = (-steepest.head(n)).asDiagonal() * graph_.directions;
  state_.rates.mean_curvature = Eigen::VectorXd::Zero(n);
  if (is_two_phase()) {
    state_.rates.order_parameter =
        -steepest.tail(n) / (material.interface_width * material.kinetic_coefficient);
  }
}

double CeresStepper::move_of(const Eigen::VectorXd& unknowns) const {
  return unknowns.head(graph_.reference.rows()).cwiseAbs().maxCoeff() / scales_.length;
}

double CeresStepper::distance() const {
  return slopes_.distance(multipliers_) / std::sqrt(scales_.energy);
}

solve::StepReport CeresStepper::report(solve::StepStatus status, std::string reason) {
  solve::StepReport result;
  result.status = status;
  result.time = state_.time;
  result.gradient = distance();
  result.counts = counts_;
  result.seconds = seconds_;
  result.reason = std::move(reason);
  result.event = std::exchange(event_, {});
  return result;
}

}  // namespace vesica::minimise
