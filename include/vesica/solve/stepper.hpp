#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/model/per_term.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::solve {

/// Counts of the work done since the stepper was made.
struct SolverCounts {
  long steps = 0;
  long newton = 0;
  long krylov = 0;
  long residuals = 0;
  long jacobians = 0;
  long factorisations = 0;
  long failures = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"steps", "-", "accepted steps"}, self.steps);
    visit(Field{"newton", "-", "nonlinear (Newton) iterations"}, self.newton);
    visit(Field{"krylov", "-", "linear (GMRES) iterations"}, self.krylov);
    visit(Field{"residuals", "-", "residual evaluations, those of difference quotients included"},
          self.residuals);
    visit(Field{"jacobians", "-", "Jacobian assemblies"}, self.jacobians);
    visit(Field{"factorisations", "-", "numerical factorisations"}, self.factorisations);
    visit(Field{"failures", "-", "failed error tests and failed Newton iterations together"},
          self.failures);
  }
  SolverCounts& operator+=(const SolverCounts& more) {
    combine_fields(*this, more, [](long& count, long other) { count += other; });
    return *this;
  }
};

/// Seconds that parts of a run took. relax() measures those of the processor around the calls of
/// steppers and controllers, and adds controllers to the total.
struct SolverSeconds {
  double processor = 0;
  double total = 0;
  double residual = 0;
  double jacobian = 0;
  double factorisation = 0;
  double solve = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"total", "second", "wall clock"}, self.total);
    visit(Field{"processor", "second", "processor time of all threads"}, self.processor);
    visit(Field{"residual", "second", "wall clock in residuals"}, self.residual);
    visit(Field{"jacobian", "second", "wall clock in Jacobian assemblies"}, self.jacobian);
    visit(Field{"factorisation", "second", "wall clock in factorisations"}, self.factorisation);
    visit(Field{"solve", "second", "wall clock in linear solves"}, self.solve);
  }
  SolverSeconds& operator+=(const SolverSeconds& more) {
    combine_fields(*this, more, [](double& seconds, double other) { seconds += other; });
    return *this;
  }
};

/// The direction, along the constraints, in which the energy curves least.
struct Curvature {
  double value = 0;      ///< eigenvalue, negative at a saddle [1/time]
  Eigen::VectorXd mode;  ///< its normal displacement at the nodes, shape (N), largest modulus 1
};

/// Report of the polish of an equilibrium.
struct PolishReport {
  bool is_converged = false;
  int iterations = 0;   ///< Newton iterations; of the weak form: implicit steps
  double gradient = 0;  ///< |dL| / |dE|; of the weak form: ||v_nu|| over the norm of the pressure
  Curvature curvature;  ///< lowest of the discrete energy

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"iterations", "-", "Newton iterations"}, self.iterations);
    visit(Field{"gradient", "-", "|dL| / |dE| or normal force over pressure"}, self.gradient);
    visit(Field{"lowest_curvature", "1/time", "negative at a saddle"}, self.curvature.value);
  }
};

enum class StepStatus { accepted, failed };

/// Report of one step. A failed step leaves the state at the last accepted one and says why.
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
  /// Of a failed step: call, code by name, and what to try. Of a finish: what was found.
  std::string reason;
  std::string event;  ///< what happened and is worth a line in the log; empty as a rule

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"gradient", "-", "distance to the minimum"}, self.gradient);
    visit(Field{"polish", "-", "what the polish found"}, self.polish);
    visit(Field{"counts", "-", "work since the start"}, self.counts);
    visit(Field{"seconds", "second", "time since the start"}, self.seconds);
  }
};

/// A method that advances a State that it owns. One of the five abstract classes of the library.
class Stepper {
 public:
  Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  virtual ~Stepper() = default;

  /// Returns the state after the last accepted step.
  [[nodiscard]] virtual const problem::State& state() const = 0;
  /// Returns the energy of the state where the method has a discrete energy of its own, in place of
  /// the one that measure::measure() integrates.
  [[nodiscard]] virtual std::optional<model::EnergyParts> energy() const { return std::nullopt; }
  /// Makes one step, not beyond `end_time`. Numerical trouble is a status, not an exception.
  virtual StepReport step(double end_time) = 0;
  /// Takes the constraints of an almost resting state to round-off, and with `polish` the state to
  /// the equilibrium; optional for a method.
  virtual StepReport finish() = 0;
  /// Sets the tangential damping alpha of equation (b) from the next step on [length^2/energy].
  virtual void set_damping(double alpha) = 0;

  /// Returns what was done to the start, a sentence each; a run records it as events at its start.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  void set_notes(std::vector<std::string> notes) { notes_ = std::move(notes); }

 private:
  std::vector<std::string> notes_;
};

/// How a run goes on from a state that was already in motion, for example on a new mesh.
struct Restart {
  double initial_step = 0;  ///< first step [time]; 0: chosen by the integrator
};

}  // namespace vesica::solve
