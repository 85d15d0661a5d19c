#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "ida_stepper.hpp"
#include "vesica/core/error.hpp"

namespace vesica::flow {

namespace {

constexpr int max_initial_iterations = 15;
constexpr double initial_tolerance = 1e-8;
constexpr double slow_convergence = 0.2;
constexpr double round_off = 1e-6;  // changes below it that no longer fall are round-off

}  // namespace

void IdaStepper::go_on_from_start(const solve::Restart& restart) {
  auto [y, y_rate] = problem_->unknowns(state_);
  y_ = std::move(y);
  y_rate_ = std::move(y_rate);
  options_.initial_step = restart.initial_step;
  has_stepped_ = true;
}

/// Newton's method for x', c', kappa and lambda at given x and c, just after the time of the state:
/// where a schedule has a kink, what comes counts. The factors are renewed only when the changes do
/// not fall fast: the equations are linear but for kappa, which starts from the recovered shape
/// operator. Near rest the rates are small differences of large forces, and their round-off may be
/// above the tolerance.
void IdaStepper::find_initial_rates() {
  const Eigen::VectorXd differential = problem_->differential_mask();
  const double time = std::nextafter(state_.time, std::numeric_limits<double>::infinity());
  double last_change = 0;
  bool needs_factors = true;
  try {
    for (int iteration = 0; iteration < max_initial_iterations; ++iteration) {
      const auto residual = system_.residual(settings_, time, y_, y_rate_);
      if (needs_factors) system_.set_up(settings_, {0, 1}, time, y_, y_rate_);
      const Eigen::VectorXd change = system_.solve(residual);
      const Eigen::VectorXd rates = change.cwiseProduct(differential);
      const Eigen::VectorXd values = change - rates;
      y_ -= values;
      y_rate_ -= rates;
      const double size =
          values.norm() / y_.norm() + rates.norm() / (y_rate_.norm() + resting_rate());
      const bool falls = iteration == 0 || size < last_change / 2;
      if (size <= (falls ? initial_tolerance : round_off)) return;
      needs_factors = iteration > 0 && size > slow_convergence * last_change;
      last_change = size;
    }
  } catch (const RecoverableError& trouble) {
    throw SolverError(
        fmt::format("initial values: {}; a finer or smoother start may help", trouble.what()));
  }
  throw SolverError(
      "initial values: Newton's method does not converge; a finer or smoother start may help");
}

/// A norm of rates that counts as rest: the shape would change by 1e-3 of its size in its natural
/// time.
double IdaStepper::resting_rate() const {
  return 1e-3 * scales_.length / scales_.time() * std::sqrt(static_cast<double>(y_.size()));
}

/// The consistent start depends on alpha: a value given before the first step changes it.
void IdaStepper::restart() {
  const ScopedTimer timer(total_seconds_);
  find_initial_rates();
  reinitialise(options_.initial_step);
  store(state_.time, y_, y_rate_);
}

}  // namespace vesica::flow
