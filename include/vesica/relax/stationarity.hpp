#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <string>

#include "vesica/core/fields.hpp"
#include "vesica/model/model.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/solve/solver_options.hpp"

namespace vesica::relax {

/// Options that tell when a run ends.
struct StopOptions {
  double normal_velocity = 1e-3;
  double constraint = 1e-8;
  double multiplier_change = 1e-3;
  double gradient = 1e-5;
  int rest_steps = 3;
  int steps_without_newton = 0;
  double end_time = std::numeric_limits<double>::infinity();
  int max_steps = 2000;
  double max_seconds = std::numeric_limits<double>::infinity();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum solve::Method;
    constexpr Users flows(ida, semi_implicit);
    visit(Field{"normal_velocity", "k/R_c^3",
                "converged below it: ||v_nu|| / R_c, rigid motion removed; k is that of phase 1",
                Rule::positive, flows},
          self.normal_velocity);
    visit(Field{"constraint", "-", "converged below it: relative errors of the constraints",
                Rule::positive},
          self.constraint);
    visit(Field{"multiplier_change", "-",
                "converged below it: relative change of the multipliers in a step", Rule::positive,
                flows},
          self.multiplier_change);
    visit(Field{"gradient", "-",
                "converged below it: distance to the minimum sqrt(g P g / k), about sqrt(2 (E - "
                "E_min) / k)",
                Rule::positive, Users(minimize)},
          self.gradient);
    visit(Field{"rest_steps", "-", "number of last steps in which the multipliers must be at rest",
                Rule::at_least_one, flows},
          self.rest_steps);
    visit(
        Field{"steps_without_newton", "-",
              "number of last steps without a quasi-Newton iteration (10 unless given, as in 3.4)",
              Rule::non_negative, Users(semi_implicit)},
        self.steps_without_newton);
    visit(Field{"end_time", "length^4/energy", "stop at this time", Rule::positive_or_infinite},
          self.end_time);
    visit(Field{"max_steps", "-", "stop after this many steps", Rule::at_least_one},
          self.max_steps);
    visit(Field{"max_seconds", "s", "stop after this wall-clock time", Rule::positive_or_infinite},
          self.max_seconds);
  }
};

/// The stopping criterion and the limits of a run. A state is an equilibrium when all of these
/// hold:
///
/// - ||v_nu|| / R_c, best-fit rigid motion removed, is below normal_velocity in k/R_c^3;
/// - no multiplier, in k/R_c^3 (volume) or k/R_c^2 (area, phase), changed by more than
///   multiplier_change times the largest (or 1, when all are small) in any of the last rest_steps;
/// - every relative constraint error is below constraint;
/// - the last steps_without_newton took no Newton iteration (rule of 3.4; IDA always iterates).
///
/// For a method that reports its distance to the minimum, that distance below `gradient` replaces
/// the conditions on velocity and multipliers.
class Stationarity {
 public:
  Stationarity(const StopOptions& options, const model::Model& model);

  /// Tells whether velocity and multipliers are at rest. To be called once a step.
  [[nodiscard]] bool is_at_rest(const StepView& view);
  /// Forgets the last steps after a change of the mesh: the multipliers have to rest anew.
  void forget_steps();
  /// Returns ||v_nu|| / R_c, best-fit rigid motion removed, in k/R_c^3 [-].
  [[nodiscard]] double normal_velocity(const measure::Diagnostics& diagnostics) const;
  /// Tells whether the velocity, or for a method that reports it the distance to the minimum, is
  /// below its threshold.
  [[nodiscard]] bool meets_velocity(const StepView& view) const;
  /// Tells whether every relative error of the constraints is below its threshold.
  [[nodiscard]] bool meets_constraints(const measure::Diagnostics& diagnostics) const;
  /// Returns in words why a state at rest is an equilibrium.
  [[nodiscard]] std::string rest_text(const StepView& view) const;
  /// Returns the stop of a state whose mesh is too coarse for its shape, so that it is no result:
  /// normals of neighbouring sub-triangles differ by more than 53 degrees. Absent when the mesh
  /// resolves the shape.
  [[nodiscard]] static std::optional<Stop> unresolved(const problem::State& state);
  /// Returns the stop for the limit that is reached; absent when none is.
  [[nodiscard]] std::optional<Stop> limit(const StepView& view) const;

 private:
  [[nodiscard]] bool multipliers_moved(const StepView& view) const;

  StopOptions options_;
  const model::Model& model_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<model::PerConstraint> last_multipliers_;
  int steps_at_rest_ = 0;
  long last_newton_ = 0;
  int steps_without_newton_ = 0;
};

}  // namespace vesica::relax
