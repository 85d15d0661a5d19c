#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "backward_euler.hpp"
#include "gauged_relaxation.hpp"
#include "ida_stepper.hpp"
#include "vesica/solve/polish.hpp"

namespace vesica::flow {

namespace {

using sundials::check;
using sundials::view;

constexpr double mesh_holding_damping = 1e4;  // natural units: nodes stay where they are

/// The longer the final step, the nearer it comes to the equilibrium. With free nodes it is given
/// up early, since they would go far; with nodes held along the surface it may take its time.
struct FinalStep {
  double growth;  // over the last step
  bool holds_mesh;
  int max_iterations;
};
constexpr std::array<FinalStep, 3> final_steps = {{{8, false, 8}, {8, true, 16}, {1, true, 16}}};

// Polish of the weak form.
constexpr int max_polish_steps = 12;
constexpr double polish_step_growth = 8;
constexpr double largest_polish_step = 1;  // natural times
constexpr double polished_gradient = 1e-8;

}  // namespace

solve::StepReport IdaStepper::finish() {
  return with_total([this] {
    try {
      if (options_.scheme == solve::Scheme::variational && options_.polish) return polish_energy();
      if (options_.polish) return polish_weak_form();
      if (options_.final_constraint_solve) take_final_step();
    } catch (const RecoverableError& trouble) {
      return report(solve::StepStatus::failed, fmt::format("final solve: {}", trouble.what()));
    }
    return report(solve::StepStatus::accepted, {});
  });
}

double IdaStepper::last_step_size() const {
  double size = 0;
  check(IDAGetLastStep(ida_.get(), &size), "IDAGetLastStep");
  return size;
}

/// The first of the final steps that can be done. Throws RecoverableError when none can.
void IdaStepper::take_final_step() {
  const double size = last_step_size();
  for (const auto& [growth, holds_mesh, max_iterations] : final_steps) {
    auto settings = settings_;
    if (holds_mesh) settings.damping = mesh_holding_damping * scales_.damping();
    try {
      if (take_implicit_step(growth * size, settings, max_iterations)) return;
    } catch (const RecoverableError&) {  // a degenerate surface: the next may be better
    }
  }
  throw RecoverableError("Newton's method does not converge");
}

/// One backward-Euler step with the constraints themselves in place of (e); false when Newton's
/// method does not converge. Throws RecoverableError for a degenerate surface.
bool IdaStepper::take_implicit_step(double size, const problem::EquationSettings& settings,
                                    int max_iterations) {
  BackwardEulerStep step{
      settings, 0, size, y_, problem_->differential_mask(), Eigen::VectorXd(y_.size())};
  const auto weights = sundials::make_vector(y_.size(), context_);
  check(IDAGetErrWeights(ida_.get(), weights.get()), "IDAGetErrWeights");
  step.weights = view(weights.get());
  step.max_iterations = max_iterations;
  step.time = state_.time + step.step_size;
  const auto y = solve_backward_euler(system_, step);
  if (!y) return false;
  y_rate_ = step.rates(*y);
  y_ = *y;
  store(step.time, y_, y_rate_);
  return true;
}

/// ||v_nu|| of the normal force that moves the surface, over that of the pressure, or of k_kappa /
/// R_c^3 where the pressure is less.
double IdaStepper::relative_force(const measure::Diagnostics& measured) const {
  const double pressure = std::abs(state_.values.multipliers.of<model::Volume>().value_or(0));
  return measured.velocity.normal /
         (std::sqrt(measured.measures.area()) * std::max(pressure, scales_.multiplier()));
}

/// The weak form has no energy to minimise: implicit steps that grow take the flow, held by the
/// rigid gauge and with its nodes held along the surface, to rest.
solve::StepReport IdaStepper::polish_weak_form() {
  const auto& model = problem_->model();
  GaugedRelaxation gauged(state_, model, options_.threads);
  solve::NewtonSystem system(gauged, options_.flow_solver());
  const Eigen::VectorXd weights = (2 * options_.rtol * gauged.units(scales_)).cwiseInverse();
  problem::State polished = state_;
  Eigen::VectorXd y = gauged.initial_values(state_);
  solve::PolishReport polish;
  double size = last_step_size();
  auto settings = settings_;
  settings.damping = mesh_holding_damping * scales_.damping();
  while (polish.iterations < max_polish_steps && !polish.is_converged) {
    const BackwardEulerStep step{settings, state_.time + size,         size,
                                 y,        gauged.differential_mask(), weights};
    const auto next = solve_backward_euler(system, step);
    if (!next) break;
    const Eigen::VectorXd rates = step.rates(*next);
    y = *next;
    ++polish.iterations;
    polished.values = gauged.values(step.time, y);
    polished.rates = gauged.rates(y, rates);
    polish.gradient = relative_force(measure::measure(model, polished));
    polish.is_converged = polish.gradient < polished_gradient;
    size = std::min(polish_step_growth * size, largest_polish_step * scales_.time());
  }
  if (polish.is_converged) {
    state_ = std::move(polished);
    polish.curvature = solve::lowest_curvature(options_, model, state_);
  }
  return polish_report(polish, system.counts(), system.seconds());
}

solve::StepReport IdaStepper::polish_energy() {
  const auto equilibrium =
      solve::find_equilibrium(options_, problem_->model(), state_, state_.values.positions);
  if (equilibrium.report.is_converged) {
    state_ = equilibrium.state;
    energy_ = equilibrium.energy;
  }
  return polish_report(equilibrium.report, equilibrium.counts, equilibrium.seconds);
}

/// With the work of the polish; failed when that found no equilibrium.
solve::StepReport IdaStepper::polish_report(const solve::PolishReport& polish,
                                            const solve::SolverCounts& counts,
                                            const solve::SolverSeconds& seconds) {
  auto result = polish.is_converged
                    ? report(solve::StepStatus::accepted, {})
                    : report(solve::StepStatus::failed, solve::no_equilibrium_text(polish));
  result.counts += counts;
  result.seconds += seconds;
  result.polish = polish;
  return result;
}

}  // namespace vesica::flow
