#pragma once

#include <optional>
#include <string>

#include "vesica/model/per_term.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::solve {

/// Work done since the stepper was made.
struct SolverCounts {
  long steps = 0;
  long newton = 0;          ///< nonlinear (Newton) iterations
  long krylov = 0;          ///< linear (GMRES) iterations
  long residuals = 0;       ///< residual evaluations, those of difference quotients included
  long jacobians = 0;       ///< Jacobian assemblies
  long factorisations = 0;  ///< numerical factorisations
  long failures = 0;        ///< failed error tests and failed Newton iterations together

  SolverCounts& operator+=(const SolverCounts& more) {
    steps += more.steps;
    newton += more.newton;
    krylov += more.krylov;
    residuals += more.residuals;
    jacobians += more.jacobians;
    factorisations += more.factorisations;
    failures += more.failures;
    return *this;
  }
};

/// Wall-clock seconds by part, and processor seconds of all threads. relax() measures the latter
/// around the calls of steppers and controllers, and adds controllers to the total.
struct SolverSeconds {
  double processor = 0;
  double total = 0;
  double residual = 0;
  double jacobian = 0;
  double factorisation = 0;
  double solve = 0;

  SolverSeconds& operator+=(const SolverSeconds& more) {
    processor += more.processor;
    total += more.total;
    residual += more.residual;
    jacobian += more.jacobian;
    factorisation += more.factorisation;
    solve += more.solve;
    return *this;
  }
};

/// The direction, along the constraints, in which the energy curves least.
struct Curvature {
  double value = 0;      ///< eigenvalue, negative at a saddle [1/time]
  Eigen::VectorXd mode;  ///< its normal displacement at the nodes, shape (N), largest modulus 1
};

/// What the polish of an equilibrium found.
struct PolishReport {
  bool is_converged = false;
  int iterations = 0;   ///< Newton iterations; of the weak form: implicit steps
  double gradient = 0;  ///< |dL| / |dE|; of the weak form: ||v_nu|| over the norm of the pressure
  Curvature curvature;  ///< lowest of the discrete energy
};

enum class StepStatus { accepted, failed };

/// What one step did. A failed step leaves the state at the last accepted one and says why.
struct StepReport {
  StepStatus status = StepStatus::accepted;
  double time = 0;       ///< time reached [time]
  double step_size = 0;  ///< size of this step [time]
  int order = 0;         ///< order of the method used
  /// Distance to the minimum sqrt(g^T P g), about sqrt(2 (E - E_min)) and independent of the mesh,
  /// over sqrt(k_kappa); only methods that minimise have it.
  std::optional<double> gradient;
  SolverCounts counts;  ///< totals after the step
  SolverSeconds seconds;
  std::optional<PolishReport> polish;  ///< after a finish() that polished
  std::string reason;                  ///< for a failed step: call, code by name, and what to try
};

/// Advances a State that it owns. One of the five abstract classes of the library.
class Stepper {
 public:
  Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  virtual ~Stepper() = default;

  [[nodiscard]] virtual const problem::State& state() const = 0;
  /// Energy of the state where the method has a discrete energy of its own, in place of the one
  /// that measure::measure() integrates.
  [[nodiscard]] virtual std::optional<model::EnergyParts> energy() const { return std::nullopt; }
  /// One step, not beyond `end_time`. Numerical trouble is a status, not an exception.
  virtual StepReport step(double end_time) = 0;
  /// Takes the constraints of an almost resting state to round-off, and with `polish` the state to
  /// the equilibrium; optional for a method.
  virtual StepReport finish() = 0;
  /// Tangential damping alpha of equation (b) from the next step on [length^2/energy].
  virtual void set_damping(double alpha) = 0;
};

/// How a run goes on from a state that was already in motion, for example on a new mesh.
struct Restart {
  double initial_step = 0;  ///< first step [time]; 0: chosen by the integrator
};

}  // namespace vesica::solve
