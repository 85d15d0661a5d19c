#pragma once

#include <memory>
#include <string>

#include "vesica/linalg/direct_solver.hpp"
#include "vesica/model/model.hpp"
#include "vesica/paper/semi_implicit_problem.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::paper {

/// The scheme of the paper: Problem 3.2 with the damping (3.4), solved as in appendices A and B. A
/// step of fixed size is one linear system with the two blocks factorised apart (same symbolic
/// factorisation for all steps), four right-hand sides, and the quasi-Newton iteration (B.1) for
/// the multipliers: every accepted state meets the constraints to 1e-8 of V, A and |A_1 - A_2| (of
/// A where that is 0). Order 1 in time.
///
/// In the reports, `newton` counts quasi-Newton iterations, `residuals` evaluations of the
/// constraints, `jacobians` assemblies and `factorisations` those of J^m (both blocks count as
/// one).
class SemiImplicitStepper final : public solve::Stepper {
 public:
  /// Starts with kappa = -tr Q_h of the surface, multipliers 0 and the paper's alpha^0 = 1e-4
  /// R_c^2/k, as far as `start` does not say otherwise. Throws ConfigError for a single-phase
  /// vesicle without a number as time step, SolverError for a degenerate start.
  SemiImplicitStepper(const solve::SolverOptions& options, const model::Model& model,
                      problem::State start);

  [[nodiscard]] const problem::State& state() const override { return state_; }
  solve::StepReport step(double end_time) override;
  /// The constraints are met already: nothing is done.
  solve::StepReport finish() override { return report(solve::StepStatus::accepted, {}); }
  void set_damping(double alpha) override { state_.damping = alpha; }

 private:
  /// One step; the text says what went wrong, empty when it was accepted.
  [[nodiscard]] std::string try_step(double end_time);
  [[nodiscard]] problem::Fields advance(double tau, double time);
  [[nodiscard]] SemiImplicitSolution solve_system();
  [[nodiscard]] problem::Fields meet_constraints(const SemiImplicitSolution& solution, double time);
  void accept(problem::Fields next, double tau, double time);
  [[nodiscard]] solve::StepReport report(solve::StepStatus status, std::string reason) const;

  problem::State state_;
  SemiImplicitProblem problem_;
  double time_step_;
  SemiImplicitSystem system_;
  std::unique_ptr<linalg::DirectSolver> geometry_solver_;
  std::unique_ptr<linalg::DirectSolver> phase_solver_;  // none for a single-phase vesicle
  double last_step_ = 0;
  solve::SolverCounts counts_;
  solve::SolverSeconds seconds_;
};

}  // namespace vesica::paper
