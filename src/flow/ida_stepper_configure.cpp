#include <sunlinsol/sunlinsol_spgmr.h>

#include <cmath>

#include "ida_linear_solvers.hpp"
#include "ida_stepper.hpp"

namespace vesica::flow {

namespace {

using sundials::check;
using sundials::view;

// Settings of GMRES and of the reuse of factors, measured: fewest factorisations over whole
// relaxations.
struct KrylovSettings {
  int dimension;
  double tolerance_factor;
};
constexpr KrylovSettings with_factors{10, 0.2};
// Exact products let Newton's method converge as fast as the linear solves are exact: with 0.05
// runs take up to 1.7 times the iterations of Newton's method, and its failures.
constexpr KrylovSettings with_preconditioner{30, 0.01};
constexpr double largest_cj_change = 0.8;
constexpr int max_newton_iterations = 6;
constexpr double multiplier_tolerance_factor =
    1e4;  // they are large at a start with kinks, and not error-tested

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
    return guarded(user_data,
                   [&](IdaStepper& self) { view(x) = self.system_.precondition(view(b)); });
  }

  static int set_up_product(realtype time, N_Vector y, N_Vector y_rate, N_Vector, realtype,
                            void* user_data) {
    return guarded(user_data, [&](IdaStepper& self) {
      self.system_.linearise(self.settings_, time, view(y), view(y_rate));
    });
  }

  static int product(realtype, N_Vector, N_Vector, N_Vector, N_Vector v, N_Vector result,
                     realtype cj, void* user_data, N_Vector, N_Vector) {
    return guarded(user_data, [&](IdaStepper& self) {
      view(result) = self.system_.product({1, cj}, view(v));
    });
  }

  static int jacobian(realtype time, realtype cj, N_Vector y, N_Vector y_rate, N_Vector r,
                      SUNMatrix, void* user_data, N_Vector, N_Vector, N_Vector) {
    return set_up_preconditioner(time, y, y_rate, r, cj, user_data);
  }
};

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
  // The norm of IDA divides by the number of all unknowns; with p among them it allows more.
  if (system_.has_products())
    tolerances *= std::sqrt((problem_->block_size() + 3.0) / problem_->block_size());
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
  const auto& krylov = system_.has_products() ? with_preconditioner : with_factors;
  linear_solver_ = sundials::LinearSolver(sundials::not_null(
      SUNLinSol_SPGMR(ida_y_.get(), SUN_PREC_LEFT, krylov.dimension, context_.get()),
      "SUNLinSol_SPGMR"));
  check(IDASetLinearSolver(ida, linear_solver_.get(), nullptr), "IDASetLinearSolver");
  check(
      IDASetPreconditioner(ida, Callbacks::set_up_preconditioner, Callbacks::solve_preconditioner),
      "IDASetPreconditioner");
  if (system_.has_products())
    check(IDASetJacTimes(ida, Callbacks::set_up_product, Callbacks::product), "IDASetJacTimes");
  check(IDASetEpsLin(ida, krylov.tolerance_factor), "IDASetEpsLin");
  check(IDASetDeltaCjLSetup(ida, largest_cj_change), "IDASetDeltaCjLSetup");
}

}  // namespace vesica::flow
