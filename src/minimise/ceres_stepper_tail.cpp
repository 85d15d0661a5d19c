#include <algorithm>
#include <cmath>
#include <tuple>

#include "ceres_stepper.hpp"
#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::minimise {

namespace {

constexpr double residual_reduction = 1e-2;  // in a Newton step
constexpr double needed_reduction = 0.5;     // of what is missing, by a step that is taken
constexpr double retry_distance = 0.3;       // of the distance at which a step was no use
constexpr double largest_rise = 1.5;        // of the distance, by the next renewal of the reference
constexpr double largest_step = 0.15;       // max|d|, in R_c
constexpr double largest_kept_move = 5e-3;  // the same, after which the reference is kept
constexpr double at_saddle = 1e-3;          // distance below which a way down is worth a line

// Trust region, by the share of the promised decrease of the Lagrangian that came about.
constexpr int max_attempts = 4;
constexpr double needed_share = 0.1;
constexpr double poor_share = 0.25;
constexpr double good_share = 0.7;
constexpr double shorter = 0.25;
constexpr double longer = 2;
constexpr double rounding = 1e-12;  // of the energy: a promise below it cannot be checked

}  // namespace

double CeresStepper::missing() const {
  const auto errors = constraints_.errors(point_.sample.constraints);
  return std::hypot(distance(), slopes_.change_for(errors).norm() / std::sqrt(scales_.energy));
}

ReducedHessian CeresStepper::hessian() {
  const ScopedTimer timer(seconds_.jacobian);
  ++counts_.jacobians;
  ++counts_.factorisations;
  return {problem_, point_.sample.fields, constraints_.all(multipliers_), graph_, options_.threads};
}

bool CeresStepper::try_newton() {
  if (distance() > newton_distance_) return false;
  newton_distance_ = retry_distance * distance();  // unless it works
  const ReducedHessian second = hessian();
  const TangentHessian tangent(second, *coordinates_, slopes_);
  bool is_taken = false;
  for (int attempt = 0; attempt < max_attempts && !is_taken; ++attempt) {
    const NewtonStep step = newton_step(tangent);
    if (!step.meets_saddle) {
      is_leaving_ = false;
    } else if (options_.leave_saddles && !is_leaving_ && distance() < at_saddle) {
      is_leaving_ = true;
      is_taken = go_down(tangent.lowest());
      if (is_taken) break;
    }
    is_taken = take_newton_step(step);
    const double promise = std::abs(step.promise(1));
    if (!options_.leave_saddles || promise < rounding * std::abs(point_.sample.energy.total()))
      break;
  }
  if (!is_taken) return false;
  newton_distance_ = std::max(near_minimum, largest_rise * distance());  // goes on while it works
  ++counts_.steps;
  store();
  return true;
}

NewtonStep CeresStepper::newton_step(const TangentHessian& tangent) {
  const ScopedTimer timer(seconds_.solve);
  const double radius = trust_radius_ * std::sqrt(scales_.energy);
  auto step =
      tangent.step(multipliers_, constraints_.errors(point_.sample.constraints), residual_reduction,
                   options_.leave_saddles ? std::optional(radius) : std::nullopt);
  counts_.krylov += step.products;
  return step;
}

double CeresStepper::lagrangian(const EnergySample& sample) const {
  return sample.energy.total() + multipliers_.dot(constraints_.errors(sample.constraints));
}

/// A step is good that halves what is missing, or lowers the Lagrangian as promised, constraints
/// met. (Multipliers of least squares: the Lagrangian has no slope along what `restored` changes.)
bool CeresStepper::take_newton_step(const NewtonStep& step) {
  const double missing_before = missing();
  const double before_value = lagrangian(point_.sample);
  const std::tuple before{point_, slopes_, multipliers_};
  const double move = move_of(coordinates_->spread(step.along));
  const double scale = std::min(1.0, largest_step / move);
  bool is_better = false;
  double share = 0;
  try {
    const Eigen::VectorXd unknowns =
        restored(moved(coordinates_->spread(step.across + scale * step.along)));
    sample_at(positions_of(graph_, unknowns), order_parameter_of(graph_, unknowns));
    point_.unknowns = unknowns;
    share = (lagrangian(point_.sample) - before_value) / step.promise(scale);
    linearise();
    const bool is_lower = step.promise(scale) < 0 && share > needed_share;
    const bool is_halved = !step.is_bounded && missing() < needed_reduction * missing_before;
    is_better = (is_lower || is_halved) &&
                !mesh_care_.is_degenerate(mesh_condition(surface(point_.sample.fields.positions)));
  } catch (const RecoverableError&) {
    share = 0;
  }
  adjust_trust(step, scale, is_better ? share : 0);
  if (!is_better) {
    std::tie(point_, slopes_, multipliers_) = before;
    return false;
  }
  stalls_ = 0;
  is_reference_old_ = move_of(point_.unknowns) > largest_kept_move;
  next_multipliers_ = multipliers_;
  return true;
}

void CeresStepper::adjust_trust(const NewtonStep& step, double scale, double share) {
  if (share < poor_share) {
    trust_radius_ = shorter * scale * step.along.norm() / std::sqrt(scales_.energy);
  } else if (step.is_bounded && scale == 1 && share > good_share) {
    trust_radius_ *= longer;
  }
}

}  // namespace vesica::minimise
