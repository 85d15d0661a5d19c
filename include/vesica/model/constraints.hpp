#pragma once

#include <optional>

#include "vesica/core/fields.hpp"
#include "vesica/model/per_term.hpp"
#include "vesica/model/schedule.hpp"
#include "vesica/model/target.hpp"

namespace vesica::model {

/// Target of one constraint as a case gives it: a number or schedule, "initial" (what the start
/// has), or "free" (no constraint).
struct Target {
  TargetKind kind = TargetKind::initial;
  Schedule schedule{};
  bool begins_at_start = false;  ///< the first value of the schedule is that of the start
  [[nodiscard]] const Schedule& parts() const { return schedule; }
  friend bool operator==(const Target&, const Target&) = default;
};

/// Returns the targets of a case file that says nothing of the constraints: "initial", or what a
/// constraint declares as `default_target`.
[[nodiscard]] inline PerTerm<Constraints, Target> default_targets() {
  PerTerm<Constraints, Target> targets;
  for_each_term<Constraints>([&]<class Constraint>(std::size_t) {
    if constexpr (requires { Constraint::default_target; })
      targets.of<Constraint>().kind = Constraint::default_target;
  });
  return targets;
}

/// Targets of the constraints (2.1), (2.4), in the units of the case or in the reduced numbers of
/// Section 4.
struct ConstraintOptions {
  PerTerm<Constraints, Target> targets = default_targets();
  std::optional<double> reduced_volume{};
  std::optional<double> phase_fraction{};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    for_each_term<Constraints>([&]<class Constraint>(std::size_t place) {
      visit(Field{Constraint::key, Constraint::unit, Constraint::meaning}, self.targets[place]);
    });
    visit(Field{"reduced_volume", "-",
                "instead of volume: v_r = V / (4 pi R_c^3 / 3), R_c = sqrt(A / 4 pi)",
                Rule::positive},
          self.reduced_volume);
    visit(
        Field{"phase_fraction", "-", "instead of phase_difference: x_r = A_2 / A", Rule::fraction},
        self.phase_fraction);
  }
  /// Refuses a quantity that is given both as a target and as a reduced number. Throws ConfigError.
  void check_together() const;
};

}  // namespace vesica::model
