#include "backward_euler.hpp"

#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <cmath>
#include <exception>

namespace vesica::flow {

namespace {

using sundials::view;

constexpr int krylov_dimension = 20;
constexpr int patience = 3;  // iterations, after which the changes must be half of the first
constexpr double negligible_change = 1e-6;
constexpr double smallest_residual = 1e-12;  // the change is what counts
constexpr double linear_tolerance = 1e-3;    // of the norm of the right-hand side
constexpr double difference = 1e-3;          // of the error allowed in a step; more is too curved

void check(int code, std::string_view call) { sundials::check(code, call, KINGetReturnFlagName); }

/// The equations of a step for KINSOL, which offers no preconditioner on the left: P^-1 r(y) = 0, P
/// the Jacobian at the start.
struct Equations {
  solve::NewtonSystem& system;
  const BackwardEulerStep& step;
  problem::EquationSettings settings;
  Eigen::VectorXd y;
  Eigen::VectorXd residual;
  double first_change = 0;
  int iterations = -1;
  std::exception_ptr failure;

  template <class Body>
  static int guarded(void* data, Body&& body) {
    auto& self = *static_cast<Equations*>(data);
    try {
      return body(self);
    } catch (...) {
      self.failure = std::current_exception();
      return -1;
    }
  }

  [[nodiscard]] double norm(const Eigen::VectorXd& change) const {
    return std::sqrt(change.cwiseProduct(step.weights).squaredNorm() /
                     static_cast<double>(change.size()));
  }

  [[nodiscard]] Eigen::VectorXd residual_at(const Eigen::VectorXd& there) const {
    return system.residual(settings, step.time, there, step.rates(there));
  }

  /// The change that led to y decides: where P holds a surrogate, P^-1 r may be a thousand times
  /// less. Zero tells KINSOL that y is a solution, -1 that there is none to be found.
  static int evaluate(N_Vector y, N_Vector result, void* data) {
    return guarded(data, [&](Equations& self) {
      const double change = self.norm(view(y) - self.y);
      self.y = view(y);
      if (++self.iterations == 1) self.first_change = change;
      view(result).setZero();
      if (self.iterations > 0 && change < negligible_change) return 0;
      if (self.iterations > patience && change > self.first_change / 2) return -1;
      self.residual = self.residual_at(self.y);
      if (self.system.has_products())
        self.system.linearise(self.settings, self.step.time, self.y, self.step.rates(self.y));
      view(result) = self.system.precondition(self.residual);
      return 0;
    });
  }

  static int multiply(N_Vector x, N_Vector product, N_Vector, booleantype*, void* data) {
    return guarded(data, [&](Equations& self) {
      if (self.system.has_products()) {
        view(product) =
            self.system.precondition(self.system.product({1, 1 / self.step.step_size}, view(x)));
        return 0;
      }
      const double length = self.norm(view(x));
      const double sigma = length > 0 ? difference / length : 1;
      const auto there = self.residual_at(self.y - sigma * view(x));
      view(product) = self.system.precondition((self.residual - there) / sigma);
      return 0;
    });
  }
};

}  // namespace

std::optional<Eigen::VectorXd> solve_backward_euler(solve::NewtonSystem& system,
                                                    const BackwardEulerStep& step) {
  Equations equations{system, step, step.settings, step.start, {}, 0, -1, {}};
  equations.settings.form = problem::ConstraintForm::original;
  system.set_up(equations.settings, {1, 1 / step.step_size}, step.time, step.start,
                step.rates(step.start));

  const auto context = sundials::make_context();
  const auto y = sundials::make_vector(step.start.size(), context);
  const auto weights = sundials::make_vector(step.start.size(), context);
  view(y.get()) = step.start;
  view(weights.get()) = step.weights;
  const sundials::LinearSolver gmres(sundials::not_null(
      SUNLinSol_SPGMR(y.get(), SUN_PREC_NONE, krylov_dimension, context.get()), "SUNLinSol_SPGMR"));
  const sundials::KinsolMemory memory(sundials::not_null(KINCreate(context.get()), "KINCreate"));
  void* kinsol = memory.get();
  check(KINSetErrHandlerFn(kinsol, sundials::silence, nullptr), "KINSetErrHandlerFn");
  check(KINInit(kinsol, Equations::evaluate, y.get()), "KINInit");
  check(KINSetUserData(kinsol, &equations), "KINSetUserData");
  check(KINSetLinearSolver(kinsol, gmres.get(), nullptr), "KINSetLinearSolver");
  check(KINSetJacTimesVecFn(kinsol, Equations::multiply), "KINSetJacTimesVecFn");
  check(KINSetEtaForm(kinsol, KIN_ETACONSTANT), "KINSetEtaForm");
  check(KINSetEtaConstValue(kinsol, linear_tolerance), "KINSetEtaConstValue");
  check(KINSetFuncNormTol(kinsol, smallest_residual), "KINSetFuncNormTol");
  check(KINSetNumMaxIters(kinsol, step.max_iterations), "KINSetNumMaxIters");

  const int code = KINSol(kinsol, y.get(), KIN_NONE, weights.get(), weights.get());
  if (equations.failure) std::rethrow_exception(equations.failure);
  const bool is_hopeless = code == KIN_SYSFUNC_FAIL || code == KIN_MAXITER_REACHED ||
                           code == KIN_MXNEWT_5X_EXCEEDED || code == KIN_LINSOLV_NO_RECOVERY ||
                           code == KIN_LSOLVE_FAIL;
  if (is_hopeless) return std::nullopt;
  check(code, "KINSol");
  return view(y.get());
}

}  // namespace vesica::flow
