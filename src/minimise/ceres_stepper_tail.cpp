#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "ceres_stepper.hpp"
#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::minimise {

namespace {

constexpr double residual_reduction = 1e-2;  // in a Newton step
constexpr double needed_reduction = 0.5;     // of what is missing, by a step that is taken
constexpr double retry_distance = 0.3;       // of the distance at which a step was no use
constexpr double largest_step = 0.15;        // max|d|, in R_c
constexpr double largest_kept_move = 5e-3;   // the same, after which the reference is kept

constexpr double marginal = 2e-4;       // modulus of a lowest eigenvalue whose sign means nothing
constexpr double at_saddle = 1e-3;      // distance below which a way down is worth a line
constexpr double leaving_move = 0.1;    // max|d| along the lowest mode, in R_c, at most
constexpr double leaving_change = 0.4;  // max|c| along it, at most
constexpr int max_halvings = 8;
constexpr int restorations = 2;

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
  const auto step = [&](bool passes_saddles) {
    const ScopedTimer timer(seconds_.solve);
    auto result = tangent.step(multipliers_, constraints_.errors(point_.sample.constraints),
                               residual_reduction, passes_saddles);
    counts_.krylov += result.products;
    return result;
  };
  const NewtonStep first = step(!options_.leave_saddles);
  const bool meets_saddle = first.meets_saddle && options_.leave_saddles;
  // a curvature that is next to nothing is no way down: to the equilibrium, whose kind is found
  // then
  if (!(meets_saddle && go_down(tangent.lowest())) &&
      !take_newton_step(meets_saddle ? step(true).change : first.change))
    return false;
  newton_distance_ = near_minimum;
  ++counts_.steps;
  store();
  return true;
}

bool CeresStepper::take_newton_step(const Eigen::VectorXd& change) {
  const double missing_before = missing();
  const std::tuple before{point_, slopes_, multipliers_};
  const Eigen::VectorXd move = coordinates_->spread(change);
  bool is_better = move_of(move) < largest_step;
  if (is_better) {
    try {
      const Eigen::VectorXd unknowns = point_.unknowns + move;
      sample_at(positions_of(graph_, unknowns), order_parameter_of(graph_, unknowns));
      point_.unknowns = unknowns;
      linearise();
      is_better =
          missing() < needed_reduction * missing_before &&
          !mesh_care_.is_degenerate(mesh_condition(surface(point_.sample.fields.positions)));
    } catch (const RecoverableError&) {
      is_better = false;
    }
  }
  if (!is_better) {
    std::tie(point_, slopes_, multipliers_) = before;
    return false;
  }
  stalls_ = 0;
  is_reference_old_ = move_of(point_.unknowns) > largest_kept_move;
  next_multipliers_ = multipliers_;
  return true;
}

/// The point with the constraints met, to second order.
Eigen::VectorXd CeresStepper::restored(Eigen::VectorXd unknowns) const {
  for (int iteration = 0; iteration < restorations; ++iteration) {
    const auto constraints =
        problem_.constraints(positions_of(graph_, unknowns), order_parameter_of(graph_, unknowns));
    unknowns -= coordinates_->spread(slopes_.change_for(constraints_.errors(constraints)));
  }
  return unknowns;
}

std::optional<GraphPoint> CeresStepper::lower_point(const Eigen::VectorXd& mode) {
  double length = leaving_move / move_of(mode);
  if (is_two_phase()) {
    const auto n = graph_.reference.rows();
    length = std::min(length, leaving_change / mode.tail(n).lpNorm<Eigen::Infinity>());
  }
  const auto value_of = [this](const EnergySample& sample) {
    return sample.energy.total() + multipliers_.dot(constraints_.errors(sample.constraints));
  };
  double value = value_of(point_.sample);
  std::optional<GraphPoint> lower;
  const auto look = [&](double along) {
    ++counts_.residuals;
    try {
      const Eigen::VectorXd unknowns = restored(point_.unknowns + along * mode);
      auto sample = sample_energy(problem_, positions_of(graph_, unknowns),
                                  order_parameter_of(graph_, unknowns));
      if (!(value_of(sample) < value)) return;
      value = value_of(sample);
      lower = GraphPoint{unknowns, std::move(sample)};
    } catch (const RecoverableError&) {
      // too far for the mesh: half as far
    }
  };
  for (int halving = 0; halving < max_halvings && !lower; ++halving, length /= 2) {
    look(length);
    look(-length);
  }
  return lower;
}

bool CeresStepper::go_down(const solve::Eigenpair& lowest) {
  counts_.krylov += lowest.products;
  if (lowest.value > -marginal) return false;
  auto lower = lower_point(coordinates_->spread(lowest.vector));
  if (!lower) return false;
  if (distance() < at_saddle) {
    event_ = fmt::format(
        "left a saddle of energy {:.7g} along its lowest mode, of relative curvature {:.2g}",
        point_.sample.energy.total(), lowest.value);
  }
  point_ = std::move(*lower);
  linearise();
  next_multipliers_ = multipliers_;
  is_reference_old_ = true;
  keeps_reference_ = false;
  stalls_ = 0;
  return true;
}

std::string CeresStepper::find_kind() {
  const ScopedTimer timer(seconds_.total);
  try {
    if (is_reference_old_) renew_reference();
    const ReducedHessian second = hessian();
    const auto lowest = TangentHessian(second, *coordinates_, slopes_).lowest();
    if (lowest.value < -marginal) {
      if (options_.leave_saddles && go_down(lowest)) {
        store();
        return {};
      }
      return fmt::format("a saddle of the energy: the lowest relative curvature is {:.2g}",
                         lowest.value);
    }
    counts_.krylov += lowest.products;
    return fmt::format(
        "a minimum{}: the lowest relative curvature is {:.2g}",
        lowest.value < marginal ? ", but for a direction of next to no curvature" : "",
        lowest.value);
  } catch (const RecoverableError& trouble) {
    return fmt::format("its curvature is not known: {}", trouble.what());
  }
}

}  // namespace vesica::minimise
