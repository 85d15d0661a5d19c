#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ceres_stepper.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/scoped_timer.hpp"

namespace vesica::minimise {

namespace {

constexpr double leaving_move = 0.1;    // max|d| along the lowest mode, in R_c, to begin with
constexpr double leaving_change = 0.4;  // max|c| along it
constexpr double largest_move = 0.3;    // max|d| at most
constexpr double longer = 1.5;
constexpr double needed_share = 0.25;  // of the decrease that the curvature promises
constexpr int max_halvings = 8;
constexpr int restorations = 2;
constexpr double bulk = 0.02;        // 1 - c^2 outside the interfaces
constexpr double worthwhile = 1e-6;  // gain by leaving a saddle, over the energy

}  // namespace

/// The point after a change, of first order in it. Where c crosses zero as the tanh of an
/// interface, a shift of the interface is a straight way in artanh(c), not in c: there the change
/// is added by tanh(q + dq) = (c + tanh dq) / (1 + c tanh dq), with dq = dc / (1 - c^2).
Eigen::VectorXd CeresStepper::moved(const Eigen::VectorXd& change) const {
  Eigen::VectorXd unknowns = point_.unknowns + change;
  if (!is_two_phase()) return unknowns;
  const auto n = graph_.reference.rows();
  const Eigen::ArrayXd c = point_.unknowns.tail(n);
  const Eigen::ArrayXd added = change.tail(n);
  const Eigen::ArrayXd slope = (1 - c.square()).max(0);
  const Eigen::ArrayXd share = slope.square() / (slope.square() + bulk * bulk);
  const Eigen::ArrayXd shift = (added * slope / (slope.square() + bulk * bulk)).tanh();
  unknowns.tail(n) = (c + shift) / (1 + c * shift) + (1 - share) * added;
  return unknowns;
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

/// Follows the mode as long as the Lagrangian falls, constraints met.
std::optional<GraphPoint> CeresStepper::lower_point(const solve::Eigenpair& lowest) {
  const Eigen::VectorXd mode = coordinates_->spread(lowest.vector);
  double length = leaving_move / move_of(mode);
  if (is_two_phase()) {
    const auto n = graph_.reference.rows();
    length = std::min(length, leaving_change / mode.tail(n).lpNorm<Eigen::Infinity>());
  }
  const double start = lagrangian(point_.sample);
  double value = start;
  std::optional<GraphPoint> lower;
  const auto falls = [&](double along) {
    ++counts_.residuals;
    try {
      const Eigen::VectorXd unknowns = restored(moved(along * mode));
      auto sample = sample_energy(problem_, positions_of(graph_, unknowns),
                                  order_parameter_of(graph_, unknowns));
      const double next = lagrangian(sample);
      if (!(next < value && next - start < needed_share * lowest.value * along * along / 2))
        return false;
      value = next;
      lower = GraphPoint{unknowns, std::move(sample)};
      return true;
    } catch (const RecoverableError&) {
      return false;  // too far for the mesh: half as far
    }
  };
  double along = length;
  for (int halving = 0; halving < max_halvings && !lower; ++halving, length /= 2) {
    falls(along = length);
    if (falls(-length)) along = -length;
  }
  if (!lower) return lower;
  do {
    along *= longer;
  } while (std::abs(along) * move_of(mode) < largest_move && falls(along));
  return lower;
}

bool CeresStepper::go_down(const solve::Eigenpair& lowest) {
  counts_.krylov += lowest.products;
  const double energy = point_.sample.energy.total();
  if (lowest.value >= 0 || left_energy_ - energy < worthwhile * std::abs(energy)) return false;
  auto lower = lower_point(lowest);
  if (!lower) return false;
  left_energy_ = energy;
  event_ = fmt::format(
      "left a saddle of energy {:.7g} along its lowest mode, of relative curvature {:.2g}", energy,
      lowest.value);
  point_ = std::move(*lower);
  linearise();
  next_multipliers_ = multipliers_;
  is_reference_old_ = true;
  keeps_reference_ = false;
  stalls_ = 0;
  return true;
}

/// The lowest value that Lanczos' method finds is an upper bound of the lowest eigenvalue, and its
/// error makes it a lower one. A negative one is a saddle when the energy does fall along the mode.
std::string CeresStepper::find_kind() {
  const ScopedTimer timer(seconds_.total);
  try {
    if (is_reference_old_) renew_reference();
    const ReducedHessian second = hessian();
    const auto lowest = TangentHessian(second, *coordinates_, slopes_).lowest();
    if (options_.leave_saddles && go_down(lowest)) {
      store();
      return {};
    }
    const bool is_known = std::abs(lowest.value) > lowest.error;
    const std::string curvature = fmt::format("the lowest relative curvature is {:.2g} +- {:.0e}",
                                              lowest.value, lowest.error);
    if (!options_.leave_saddles && lowest.value < 0 && lower_point(lowest))
      return "a saddle of the energy: " + curvature;
    return fmt::format(
        "a minimum{}: {}",
        lowest.value > 0 && is_known ? "" : ", but for a direction of next to no curvature",
        curvature);
  } catch (const RecoverableError& trouble) {
    return fmt::format("its curvature is not known: {}", trouble.what());
  }
}

}  // namespace vesica::minimise
