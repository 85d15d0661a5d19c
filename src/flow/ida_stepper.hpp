#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "solve/newton_system.hpp"
#include "sundials.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::flow {

/// Integrates the relaxation flow with SUNDIALS IDA in one-step mode: variable step, BDF of
/// variable order, error control on x and c. Newton systems: GMRES with the factors of an older
/// Jacobian as preconditioner, or those factors directly; for ReducedProblem GMRES with exact
/// products and the preconditioner from factors of second-order operators.
class IdaStepper final : public solve::Stepper {
 public:
  /// Without `restart` consistent initial values are found here; throws SolverError when there are
  /// none. With it the values and rates of `start` are taken as they are.
  IdaStepper(const solve::SolverOptions& options, const model::Model& model, problem::State start,
             const std::optional<solve::Restart>& restart = {});

  [[nodiscard]] const problem::State& state() const override { return state_; }
  [[nodiscard]] std::optional<model::EnergyParts> energy() const override { return energy_; }
  solve::StepReport step(double end_time) override;
  solve::StepReport finish() override;
  void set_damping(double alpha) override;

 private:
  struct Callbacks;

  /// The report of a call, with the seconds of all calls as the total.
  template <class Call>
  solve::StepReport with_total(Call&& call) {
    solve::StepReport result;
    {
      const ScopedTimer timer(total_seconds_);
      result = call();
    }
    result.seconds.total = total_seconds_;
    return result;
  }

  [[nodiscard]] solve::StepReport take_step(double end_time);
  void go_on_from_start(const solve::Restart& restart);
  void find_initial_rates();
  [[nodiscard]] double resting_rate() const;
  void restart();
  solve::StepReport begin_stage(const solve::StepReport& reached);
  void reinitialise(double initial_step);
  [[nodiscard]] double last_step_size() const;
  void take_final_step();
  bool take_implicit_step(double size, const problem::EquationSettings& settings,
                          int max_iterations);
  [[nodiscard]] double relative_force(const measure::Diagnostics& measured) const;
  [[nodiscard]] solve::StepReport polish_weak_form();
  [[nodiscard]] solve::StepReport polish_energy();
  [[nodiscard]] solve::StepReport polish_report(const solve::PolishReport& polish,
                                                const solve::SolverCounts& counts,
                                                const solve::SolverSeconds& seconds);
  void configure_ida();
  void configure_linear_solver();
  [[nodiscard]] Eigen::VectorXd error_tolerances() const;
  [[nodiscard]] double next_stop_time(double end_time) const;
  void store(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate);
  [[nodiscard]] solve::SolverCounts ida_counts() const;
  [[nodiscard]] solve::StepReport report(solve::StepStatus status, std::string reason);
  [[nodiscard]] std::string failure_text(int code) const;

  solve::SolverOptions options_;
  problem::State state_;
  problem::Scales scales_;
  std::unique_ptr<problem::FlowProblem> problem_;
  problem::EquationSettings settings_;
  solve::NewtonSystem system_;
  Eigen::VectorXd y_;
  Eigen::VectorXd y_rate_;
  bool has_stepped_ = false;
  solve::SolverCounts earlier_counts_;  // of IDA before its last initialisation
  double total_seconds_ = 0;
  std::optional<model::EnergyParts> energy_;  // of a discretisation that has one
  std::exception_ptr fatal_;                  // thrown in a callback, rethrown after the C call
  std::string last_trouble_;                  // text of the last RecoverableError
  sundials::Context context_;                 // SUNDIALS objects in the order of dependence
  sundials::Vector ida_y_;
  sundials::Vector ida_y_rate_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_solver_;
  sundials::IdaMemory ida_;
};

}  // namespace vesica::flow
