#pragma once

#include <memory>

#include "vesica/model/units.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::run {

/// Returns the powers of two that are nearest to R_c and to the bending rigidity of phase 1, so that
/// a problem in these units has numbers near 1 and conversions round nothing; the units of the case
/// where both are within a factor of 8 of 1.
[[nodiscard]] model::Units near_natural_units(const model::Model& model,
                                              const problem::State& start);

/// Returns the state in other units; `units.inverse()` takes it back. Its time stays as it is.
[[nodiscard]] problem::State in_units(const problem::State& state, const model::Units& units);

/// Returns the options with their times in other units. `interface_width`, in the units of the case,
/// is for a time step that follows from it; 0 where there is none.
[[nodiscard]] solve::SolverOptions in_units(const solve::SolverOptions& options,
                                            const model::Units& units, double interface_width);

/// A stepper that computes in other units than those of its caller: sparse factors in single
/// precision, and sums of lengths and curvatures, want numbers near 1, and a case may be in metres
/// and joules.
class ScaledStepper final : public solve::Stepper {
 public:
  /// Takes a stepper whose model and start are in `units`, and whose times are in `clock`: the unit
  /// of time, or 1 where time counts iterations.
  ScaledStepper(std::unique_ptr<solve::Stepper> stepper, const model::Units& units, double clock);

  [[nodiscard]] const problem::State& state() const override { return state_; }
  [[nodiscard]] std::optional<model::EnergyParts> energy() const override;
  solve::StepReport step(double end_time) override;
  solve::StepReport finish() override;
  void set_damping(double alpha) override;

 private:
  [[nodiscard]] solve::StepReport converted(solve::StepReport report);
  void take_state();

  std::unique_ptr<solve::Stepper> stepper_;
  model::Units units_;
  double clock_;
  problem::State state_;
};

}  // namespace vesica::run
