#pragma once

#include <limits>
#include <optional>
#include <string>

#include "inner_minimisation.hpp"
#include "mesh_care.hpp"
#include "tangent_newton.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/solve/polish.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::minimise {

/// Who looks after the mesh: the stepper moves nodes along the surface, or its caller remeshes. A
/// mesh whose elements differ in size on purpose must not be made even.
enum class MeshKeeper { stepper, caller };

/// Distance to the minimum, in k_1^(1/2), below which second derivatives are of use.
constexpr double near_minimum = 1e-2;

/// Minimises the discrete energy at fixed volume, area and phase difference. A step is one outer
/// iteration: a normal graph over the present surface, multipliers, some iterations of L-BFGS on
/// the augmented Lagrangian in preconditioned variables, and when the mesh has become worse, a
/// redistribution of its nodes along the surface (docs/lab-notes/minimisation.md). A step whose
/// mesh is degenerate or whose line search finds nothing is tried again with shorter steps, then
/// fails.
///
/// There is no time: `State::time` counts outer iterations on from that of the start, so that the
/// frames of a run are apart, and the rates are the velocity that the gradient flow would have in
/// the state. In the reports, `newton` counts iterations of L-BFGS, `residuals` evaluations of
/// energy and gradient, `jacobians` the surfaces whose operators were assembled, `factorisations`
/// those of Cholesky and `failures` the trial points and inner minimisations that were thrown away.
class CeresStepper final : public solve::Stepper {
 public:
  /// Makes the stepper. Throws ConfigError for a target that changes in time, SolverError for a
  /// degenerate start.
  CeresStepper(const solve::SolverOptions& options, const model::Model& model, problem::State start,
               MeshKeeper keeper = MeshKeeper::stepper);

  [[nodiscard]] const problem::State& state() const override { return state_; }
  [[nodiscard]] std::optional<model::EnergyParts> energy() const override {
    return point_.sample.energy;
  }
  solve::StepReport step(double end_time) override;
  /// Takes the constraints to round-off along the steepest directions of the metric, or with
  /// `polish` the state to the equilibrium.
  solve::StepReport finish() override;
  /// Nothing is damped here: the nodes move along normals, or are redistributed.
  void set_damping(double) override {}

 private:
  /// Tries a step and returns what went wrong; empty when it succeeded.
  [[nodiscard]] std::string try_step();
  void renew_reference();
  void linearise();
  [[nodiscard]] InnerResult minimise(const InnerProblem& inner);
  [[nodiscard]] InnerProblem inner_problem() const;
  [[nodiscard]] Eigen::VectorXd penalties() const;
  void choose_multipliers(const InnerProblem& last, double error_before);
  /// Returns what speaks against the result of an inner minimisation; empty when nothing does.
  [[nodiscard]] std::string objection(const InnerResult& result);
  void accept(InnerResult result, const InnerProblem& inner);
  /// Tells whether a Newton step, or one away from a saddle, has been made in place of L-BFGS.
  [[nodiscard]] bool try_newton();
  [[nodiscard]] NewtonStep newton_step(const TangentHessian& tangent);
  [[nodiscard]] bool take_newton_step(const NewtonStep& step);
  void adjust_trust(const NewtonStep& step, double scale, double share);
  [[nodiscard]] ReducedHessian hessian();
  [[nodiscard]] Eigen::VectorXd moved(const Eigen::VectorXd& change) const;
  [[nodiscard]] Eigen::VectorXd restored(Eigen::VectorXd unknowns) const;
  /// Returns a point of lower energy along the lowest mode, one way or the other.
  [[nodiscard]] std::optional<GraphPoint> lower_point(const solve::Eigenpair& lowest);
  /// Moves to lower energy along the lowest mode; false when that does not curve downwards.
  [[nodiscard]] bool go_down(const solve::Eigenpair& lowest);
  /// Returns what kind of equilibrium the state is; empty when it is a saddle that has been left.
  [[nodiscard]] std::string find_kind();
  [[nodiscard]] double lagrangian(const EnergySample& sample) const;
  /// Returns the size of what is missing from the equilibrium, constraints included, in k_1^(1/2).
  [[nodiscard]] double missing() const;
  void care_for_mesh();
  void retreat();
  void sample_at(const mesh::Positions& positions, const Eigen::VectorXd& order_parameter);
  [[nodiscard]] std::string restore_constraints();
  [[nodiscard]] solve::StepReport polish();
  [[nodiscard]] solve::StepReport meet_constraints();
  void take(const solve::Equilibrium& equilibrium);
  void store();
  [[nodiscard]] solve::StepReport report(solve::StepStatus status, std::string reason);
  [[nodiscard]] std::string stall_text() const;
  [[nodiscard]] std::string constraint_text() const;

  [[nodiscard]] bool is_two_phase() const { return problem_.model().is_two_phase; }
  [[nodiscard]] mesh::Surface surface(const mesh::Positions& positions) const {
    return {state_.triangulation, positions};
  }
  /// Returns max|d| in units of R_c.
  [[nodiscard]] double move_of(const Eigen::VectorXd& unknowns) const;
  /// Returns the distance to the minimum, in k_1^(1/2).
  [[nodiscard]] double distance() const;

  solve::SolverOptions options_;
  problem::State state_;
  problem::Scales scales_;
  problem::EnergyProblem problem_;
  ConstraintSet constraints_;
  EnergyMetric metric_;
  MeshCare mesh_care_;
  MeshKeeper keeper_;
  double first_time_;
  problem::NormalGraph graph_;
  std::optional<MinimiserCoordinates> coordinates_;  // of graph_ and metric_
  GraphPoint point_;
  Slopes slopes_;
  Eigen::VectorXd multipliers_;       // least squares in the metric: those of the state
  Eigen::VectorXd next_multipliers_;  // of the next inner minimisation
  double penalty_growth_ = 1;
  bool is_reference_old_ = false;  // the next step takes a new one
  bool keeps_reference_ = false;   // near the end
  double reference_quality_ = 0;
  double trial_step_ = 1;
  int stalls_ = 0;             // steps in a row that gained next to nothing
  double newton_distance_;     // Newton's method below it
  double trust_radius_ = 0.3;  // of a Newton step in z, in k_1^(1/2)
  bool is_leaving_ = false;    // a saddle
  double left_energy_ = std::numeric_limits<double>::infinity();  // of the last saddle
  std::string event_;                                             // of the next report
  solve::SolverCounts counts_;
  solve::SolverSeconds seconds_;
};

}  // namespace vesica::minimise
