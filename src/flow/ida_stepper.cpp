#include "ida_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "problem/reduced_problem.hpp"
#include "vesica/problem/relaxation_problem.hpp"
#include "vesica/problem/variational_problem.hpp"

namespace vesica::flow {

namespace {

using sundials::check;
using sundials::view;

constexpr double restart_step_factor = 0.3;  // of the last step, for new coordinates

/// The equations of the flow on the mesh of the start.
std::unique_ptr<problem::FlowProblem> make_problem(const solve::SolverOptions& options,
                                                   const model::Model& model,
                                                   const problem::State& start) {
  if (options.is_preconditioned()) {
    return std::make_unique<problem::ReducedProblem>(start.triangulation, model,
                                                     start.values.positions, options.threads);
  }
  if (options.scheme == solve::Scheme::variational) {
    return std::make_unique<problem::VariationalProblem>(start.triangulation, model,
                                                         start.values.positions, options.threads);
  }
  return std::make_unique<problem::RelaxationProblem>(start.triangulation, model, options.threads);
}

solve::NewtonSystem make_system(const solve::SolverOptions& options,
                                const problem::FlowProblem& problem,
                                const problem::Scales& scales) {
  if (options.is_preconditioned())
    return {dynamic_cast<const problem::ReducedProblem&>(problem), scales};
  return {dynamic_cast<const problem::AssembledProblem&>(problem), options.flow_solver()};
}

}  // namespace

IdaStepper::IdaStepper(const solve::SolverOptions& options, const model::Model& model,
                       problem::State start, const std::optional<solve::Restart>& restart)
    : options_(options),
      state_(std::move(start)),
      scales_(problem::scales_of(model, state_)),
      problem_(make_problem(options, model, state_)),
      settings_{scales_.damping(), options.constraint_rate / scales_.time(),
                problem::ConstraintForm::differentiated},
      system_(make_system(options, *problem_, scales_)),
      y_(problem_->initial_values(state_)),
      y_rate_(Eigen::VectorXd::Zero(y_.size())),
      context_(sundials::make_context()) {
  if (state_.damping > 0) settings_.damping = state_.damping;
  const ScopedTimer timer(total_seconds_);
  if (restart) {
    go_on_from_start(*restart);
  } else {
    find_initial_rates();
  }
  store(state_.time, y_, y_rate_);
  configure_ida();
}

/// Steps end where a schedule has a kink or jumps: the multipliers jump there.
double IdaStepper::next_stop_time(double end_time) const {
  return std::min(end_time, problem_->model().next_kink(state_.time));
}

solve::StepReport IdaStepper::step(double end_time) {
  return with_total([&] { return take_step(end_time); });
}

solve::StepReport IdaStepper::take_step(double end_time) {
  const double stop_time = next_stop_time(end_time);
  if (std::isfinite(stop_time)) check(IDASetStopTime(ida_.get(), stop_time), "IDASetStopTime");
  const double target = std::isfinite(stop_time) ? stop_time : state_.time + scales_.time();
  last_trouble_.clear();
  has_stepped_ = true;
  realtype time = state_.time;
  const int code =
      IDASolve(ida_.get(), target, &time, ida_y_.get(), ida_y_rate_.get(), IDA_ONE_STEP);
  if (fatal_) std::rethrow_exception(std::exchange(fatal_, nullptr));
  if (code < 0) return report(solve::StepStatus::failed, failure_text(code));
  y_ = view(ida_y_.get());
  y_rate_ = view(ida_y_rate_.get());
  store(time, y_, y_rate_);
  const auto result = report(solve::StepStatus::accepted, {});
  const bool is_renewed = problem_->renew_coordinates(y_, y_rate_);
  if (is_renewed) store(time, y_, y_rate_);
  if (problem_->model().jumps_at(time)) return begin_stage(result);
  if (is_renewed) reinitialise(restart_step_factor * last_step_size());
  return result;
}

/// After a jump of a target or of the material the velocity and the algebraic unknowns are other
/// ones: found anew, as at the start. The state stays what the step has reached.
solve::StepReport IdaStepper::begin_stage(const solve::StepReport& reached) {
  try {
    find_initial_rates();
  } catch (const SolverError& error) {
    return report(solve::StepStatus::failed, error.what());
  }
  reinitialise(options_.initial_step);
  return reached;
}

void IdaStepper::set_damping(double alpha) {
  if (alpha == settings_.damping) return;
  settings_.damping = alpha;
  state_.damping = alpha;
  const bool has_damping = options_.scheme == solve::Scheme::paper;
  if (has_damping && !has_stepped_) restart();
}

/// IDA goes on from (y, y') with order one. It forgets its counters, which are kept here.
void IdaStepper::reinitialise(double initial_step) {
  earlier_counts_ = ida_counts();
  view(ida_y_.get()) = y_;
  view(ida_y_rate_.get()) = y_rate_;
  check(IDAReInit(ida_.get(), state_.time, ida_y_.get(), ida_y_rate_.get()), "IDAReInit");
  check(IDASetInitStep(ida_.get(), initial_step), "IDASetInitStep");
}

void IdaStepper::store(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  state_.time = time;
  state_.values = system_.values(time, y);
  energy_ = system_.energy(time, y);
  state_.rates = problem_->rates(y, y_rate);
  state_.damping = settings_.damping;
}

solve::StepReport IdaStepper::report(solve::StepStatus status, std::string reason) {
  solve::StepReport result;
  result.status = status;
  result.time = state_.time;
  result.reason = std::move(reason);
  result.counts = system_.counts();
  result.seconds = system_.seconds();
  const auto counts = ida_counts();
  result.counts.steps = counts.steps;
  result.counts.newton = counts.newton;
  result.counts.krylov = counts.krylov;
  result.counts.failures = counts.failures;
  check(IDAGetLastStep(ida_.get(), &result.step_size), "IDAGetLastStep");
  check(IDAGetLastOrder(ida_.get(), &result.order), "IDAGetLastOrder");
  return result;
}

/// What IDA counts, since the stepper was made.
solve::SolverCounts IdaStepper::ida_counts() const {
  void* ida = ida_.get();
  solve::SolverCounts counts;
  long error_failures = 0;
  long newton_failures = 0;
  check(IDAGetNumSteps(ida, &counts.steps), "IDAGetNumSteps");
  check(IDAGetNumNonlinSolvIters(ida, &counts.newton), "IDAGetNumNonlinSolvIters");
  check(IDAGetNumLinIters(ida, &counts.krylov), "IDAGetNumLinIters");
  check(IDAGetNumErrTestFails(ida, &error_failures), "IDAGetNumErrTestFails");
  check(IDAGetNumNonlinSolvConvFails(ida, &newton_failures), "IDAGetNumNonlinSolvConvFails");
  counts.failures = error_failures + newton_failures;
  return counts += earlier_counts_;
}

std::string IdaStepper::failure_text(int code) const {
  const long steps = ida_counts().steps;
  realtype last_step = 0;
  check(IDAGetCurrentStep(ida_.get(), &last_step), "IDAGetCurrentStep");
  return fmt::format(
      "IDASolve at t = {:.6g}: {}, {} steps, last step tried {:.2g}{}{}; a finer mesh, a larger "
      "interface_width or "
      "another damping kind may help, or the shape pinches off",
      state_.time, sundials::code_text(code), steps, last_step, last_trouble_.empty() ? "" : "; ",
      last_trouble_);
}

}  // namespace vesica::flow
