#include "ida_stepper.hpp"

#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "ida_linear_solvers.hpp"
#include "vesica/problem/relaxation_problem.hpp"
#include "vesica/problem/variational_problem.hpp"

namespace vesica::flow {

namespace {

using sundials::check;
using sundials::view;

// Settings of GMRES and of the reuse of factors, measured: fewest factorisations over whole
// relaxations.
constexpr int krylov_dimension = 10;
constexpr double krylov_tolerance_factor = 0.2;
constexpr double largest_cj_change = 0.8;
constexpr int max_newton_iterations = 6;
constexpr double multiplier_tolerance_factor =
    1e4;  // they are large at a start with kinks, and not error-tested

constexpr double restart_step_factor = 0.3;  // of the last step, for new coordinates

/// The equations of the flow on the mesh of the start.
std::unique_ptr<problem::FlowProblem> make_problem(const solve::SolverOptions& options,
                                                   const model::Model& model,
                                                   const problem::State& start) {
  if (options.scheme == solve::Scheme::variational) {
    return std::make_unique<problem::VariationalProblem>(start.triangulation, model,
                                                         start.values.positions, options.threads);
  }
  return std::make_unique<problem::RelaxationProblem>(start.triangulation, model, options.threads);
}

}  // namespace

/// Thin callbacks: they catch everything; +1 asks IDA for a smaller step, -1 ends the call.
struct IdaStepper::Callbacks {
  template <class Body>
  static int guarded(void* user_data, Body&& body) {
    auto& self = *static_cast<IdaStepper*>(user_data);
    try {
      body(self);
      return 0;
    } catch (const RecoverableError& trouble) {
      self.last_trouble_ = trouble.what();
      return 1;
    } catch (...) {
      self.fatal_ = std::current_exception();
      return -1;
    }
  }

  static int residual(realtype time, N_Vector y, N_Vector y_rate, N_Vector result,
                      void* user_data) {
    return guarded(user_data, [&](IdaStepper& self) {
      view(result) = self.system_.residual(self.settings_, time, view(y), view(y_rate));
    });
  }

  static int set_up_preconditioner(realtype time, N_Vector y, N_Vector y_rate, N_Vector,
                                   realtype cj, void* user_data) {
    return guarded(user_data, [&](IdaStepper& self) {
      self.system_.set_up(self.settings_, {1, cj}, time, view(y), view(y_rate));
    });
  }

  static int solve_preconditioner(realtype, N_Vector, N_Vector, N_Vector, N_Vector b, N_Vector x,
                                  realtype, realtype, void* user_data) {
    return guarded(user_data, [&](IdaStepper& self) { view(x) = self.system_.solve(view(b)); });
  }

  static int jacobian(realtype time, realtype cj, N_Vector y, N_Vector y_rate, N_Vector r,
                      SUNMatrix, void* user_data, N_Vector, N_Vector, N_Vector) {
    return set_up_preconditioner(time, y, y_rate, r, cj, user_data);
  }
};

IdaStepper::IdaStepper(const solve::SolverOptions& options, const model::Model& model,
                       problem::State start, const std::optional<solve::Restart>& restart)
    : options_(options),
      state_(std::move(start)),
      scales_(problem::scales_of(model, state_)),
      problem_(make_problem(options, model, state_)),
      settings_{scales_.damping(), options.constraint_rate / scales_.time(),
                problem::ConstraintForm::differentiated},
      system_(*problem_, options.linear_solver),
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

void IdaStepper::configure_ida() {
  const auto size = problem_->size();
  ida_y_ = sundials::make_vector(size, context_);
  ida_y_rate_ = sundials::make_vector(size, context_);
  view(ida_y_.get()) = y_;
  view(ida_y_rate_.get()) = y_rate_;
  ida_ = sundials::IdaMemory(sundials::not_null(IDACreate(context_.get()), "IDACreate"));
  void* ida = ida_.get();
  check(IDASetErrHandlerFn(ida, sundials::silence, nullptr), "IDASetErrHandlerFn");
  check(IDAInit(ida, Callbacks::residual, state_.time, ida_y_.get(), ida_y_rate_.get()), "IDAInit");
  check(IDASetUserData(ida, this), "IDASetUserData");

  const auto tolerances = sundials::make_vector(size, context_);
  view(tolerances.get()) = error_tolerances();
  check(IDASVtolerances(ida, 0.0, tolerances.get()), "IDASVtolerances");

  const auto kinds = sundials::make_vector(size, context_);
  view(kinds.get()) = problem_->differential_mask();
  check(IDASetId(ida, kinds.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
  check(IDASetMaxOrd(ida, options_.max_order), "IDASetMaxOrd");
  if (options_.initial_step > 0)
    check(IDASetInitStep(ida, options_.initial_step), "IDASetInitStep");
  if (std::isfinite(options_.max_step))
    check(IDASetMaxStep(ida, options_.max_step), "IDASetMaxStep");
  configure_linear_solver();
  check(IDASetMaxNonlinIters(ida, max_newton_iterations), "IDASetMaxNonlinIters");
}

/// The error allowed in each unknown, relative to its natural unit (the diameter 2 R_c, the range
/// of c) and not to the single value: the steps do not depend on where the origin is.
Eigen::VectorXd IdaStepper::error_tolerances() const {
  Eigen::VectorXd tolerances = (2 * options_.rtol + options_.atol) * problem_->units(scales_);
  tolerances.tail(problem_->num_multipliers())
      .setConstant(options_.rtol * multiplier_tolerance_factor * scales_.multiplier());
  return tolerances;
}

void IdaStepper::configure_linear_solver() {
  void* ida = ida_.get();
  if (options_.newton == solve::NewtonMode::direct) {
    matrix_ = make_system_matrix(context_);
    linear_solver_ = make_system_solver(system_, context_);
    check(IDASetLinearSolver(ida, linear_solver_.get(), matrix_.get()), "IDASetLinearSolver");
    check(IDASetJacFn(ida, Callbacks::jacobian), "IDASetJacFn");
    return;
  }
  linear_solver_ = sundials::LinearSolver(sundials::not_null(
      SUNLinSol_SPGMR(ida_y_.get(), SUN_PREC_LEFT, krylov_dimension, context_.get()),
      "SUNLinSol_SPGMR"));
  check(IDASetLinearSolver(ida, linear_solver_.get(), nullptr), "IDASetLinearSolver");
  check(
      IDASetPreconditioner(ida, Callbacks::set_up_preconditioner, Callbacks::solve_preconditioner),
      "IDASetPreconditioner");
  check(IDASetEpsLin(ida, krylov_tolerance_factor), "IDASetEpsLin");
  check(IDASetDeltaCjLSetup(ida, largest_cj_change), "IDASetDeltaCjLSetup");
}

/// Steps end where a schedule has a kink or jumps: the multipliers jump there.
double IdaStepper::next_stop_time(double end_time) const {
  return std::min(end_time, problem_->model().next_kink(state_.time));
}

std::optional<model::EnergyParts> IdaStepper::energy() const {
  return polished_energy_ ? polished_energy_ : problem_->energy(state_.time, y_);
}

solve::StepReport IdaStepper::step(double end_time) {
  return with_total([&] { return take_step(end_time); });
}

solve::StepReport IdaStepper::take_step(double end_time) {
  const double stop_time = next_stop_time(end_time);
  if (std::isfinite(stop_time)) check(IDASetStopTime(ida_.get(), stop_time), "IDASetStopTime");
  const double target = std::isfinite(stop_time) ? stop_time : state_.time + scales_.time();
  last_trouble_.clear();
  polished_energy_.reset();
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
  if (!has_stepped_) restart();
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
  state_.values = problem_->values(time, y);
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
