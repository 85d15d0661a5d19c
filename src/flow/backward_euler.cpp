#include "backward_euler.hpp"

#include <sunlinsol/sunlinsol_spgmr.h>

#include <cmath>
#include <exception>
#include <utility>

namespace vesica::flow {

namespace {

using sundials::check;
using sundials::view;

constexpr int krylov_dimension = 20;
constexpr int patience = 3;  // iterations, after which the changes must be half of the first
constexpr double negligible_change = 1e-6;
constexpr double linear_tolerance = 1e-3;  // of the norm of the right-hand side
constexpr double difference = 1e-3;        // of the error allowed in a step; more is too curved

/// The linear system at one Newton iterate, for SPGMR.
struct LinearSystem {
  solve::NewtonSystem& system;
  const BackwardEulerStep& step;
  problem::EquationSettings settings;
  Eigen::VectorXd y;
  Eigen::VectorXd residual;
  std::exception_ptr failure;

  template <class Body>
  static int guarded(void* data, Body&& body) {
    auto& self = *static_cast<LinearSystem*>(data);
    try {
      body(self);
      return 0;
    } catch (...) {
      self.failure = std::current_exception();
      return -1;
    }
  }

  [[nodiscard]] double norm(const Eigen::VectorXd& change) const {
    return std::sqrt(change.cwiseProduct(step.weights).squaredNorm() /
                     static_cast<double>(change.size()));
  }

  static int multiply(void* data, N_Vector x, N_Vector product) {
    return guarded(data, [&](LinearSystem& self) {
      const Eigen::VectorXd direction = view(x);
      const double length = self.norm(direction);
      const double sigma = length > 0 ? difference / length : 1;
      const Eigen::VectorXd moved = self.y + sigma * direction;
      const auto there =
          self.system.residual(self.settings, self.step.time, moved, self.step.rates(moved));
      view(product) = (there - self.residual) / sigma;
    });
  }

  static int precondition(void* data, N_Vector b, N_Vector x, realtype, int) {
    return guarded(data, [&](LinearSystem& self) { view(x) = self.system.solve(view(b)); });
  }
};

class Gmres {
 public:
  explicit Gmres(LinearSystem& system)
      : system_(system),
        context_(sundials::make_context()),
        x_(sundials::make_vector(system.y.size(), context_)),
        b_(sundials::make_vector(system.y.size(), context_)),
        weights_(sundials::make_vector(system.y.size(), context_)),
        solver_(sundials::not_null(
            SUNLinSol_SPGMR(x_.get(), SUN_PREC_LEFT, krylov_dimension, context_.get()),
            "SUNLinSol_SPGMR")) {
    view(weights_.get()) = system.step.weights;
    check(SUNLinSolSetATimes(solver_.get(), &system_, LinearSystem::multiply),
          "SUNLinSolSetATimes");
    check(SUNLinSolSetPreconditioner(solver_.get(), &system_, nullptr, LinearSystem::precondition),
          "SUNLinSolSetPreconditioner");
    check(SUNLinSolSetScalingVectors(solver_.get(), weights_.get(), weights_.get()),
          "SUNLinSolSetScalingVectors");
    check(SUNLinSolInitialize(solver_.get()), "SUNLinSolInitialize");
  }

  /// A solution as good as the Krylov space gives; Newton's method looks after the rest.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) {
    view(b_.get()) = b;
    view(x_.get()).setZero();
    const auto scale = std::sqrt(static_cast<double>(b.size()));
    const double tolerance = linear_tolerance * scale * system_.norm(system_.system.solve(b));
    (void)SUNLinSolSolve(solver_.get(), nullptr, x_.get(), b_.get(), tolerance);
    if (system_.failure) std::rethrow_exception(std::exchange(system_.failure, nullptr));
    return view(x_.get());
  }

 private:
  LinearSystem& system_;
  sundials::Context context_;
  sundials::Vector x_;
  sundials::Vector b_;
  sundials::Vector weights_;
  sundials::LinearSolver solver_;
};

}  // namespace

std::optional<Eigen::VectorXd> solve_backward_euler(solve::NewtonSystem& system,
                                                    const BackwardEulerStep& step) {
  LinearSystem linear{system, step, step.settings, step.start, {}, {}};
  linear.settings.form = problem::ConstraintForm::original;
  system.set_up(linear.settings, {1, 1 / step.step_size}, step.time, linear.y,
                step.rates(linear.y));
  Gmres gmres(linear);
  double first_change = 0;
  for (int iteration = 0; iteration < step.max_iterations; ++iteration) {
    linear.residual = system.residual(linear.settings, step.time, linear.y, step.rates(linear.y));
    const Eigen::VectorXd change = gmres.solve(linear.residual);
    linear.y -= change;
    const double size = linear.norm(change);
    if (size < negligible_change) return linear.y;
    if (iteration == 0) first_change = size;
    if (iteration >= patience && size > first_change / 2) break;
  }
  return std::nullopt;
}

}  // namespace vesica::flow
