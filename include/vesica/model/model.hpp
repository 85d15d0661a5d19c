#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "vesica/model/constraints.hpp"
#include "vesica/model/material.hpp"
#include "vesica/model/per_term.hpp"

namespace vesica::model {

/// Targets of the active constraints; an absent one leaves its quantity free.
using Targets = PerTerm<Constraints, std::optional<Schedule>>;

/// The material at one time, whether there is a phase field, and which constraints have no target:
/// all that decides which terms take part.
struct Physics {
  Material material;
  bool is_two_phase = true;
  PerTerm<Constraints, bool> is_free{};
};

/// Tells whether a term takes part: a term that needs the phase field does so only where there is
/// one, and a term with `is_present(material)` only where that is true.
template <class Term>
[[nodiscard]] bool takes_part(const Physics& physics) {
  if (Term::needs_phase_field && !physics.is_two_phase) return false;
  if constexpr (requires { Term::is_present(physics.material); }) {
    return Term::is_present(physics.material);
  } else {
    return true;
  }
}

/// The model of a vesicle: its material, whether it has a phase field, and its constraints.
/// Material and targets may change in time.
struct Model {
  MaterialOptions material;
  bool is_two_phase = true;
  Targets targets;

  /// Returns the physics at a time.
  [[nodiscard]] Physics at(double time) const;
  /// Returns the first time after `time` at which a material parameter or a target has a kink or
  /// jumps; infinity when there is none.
  [[nodiscard]] double next_kink(double time) const;
  /// Tells whether a material parameter or a target jumps at `time`.
  [[nodiscard]] bool jumps_at(double time) const;
  /// Returns the time of the last kink or jump; minus infinity when nothing changes.
  [[nodiscard]] double rests_after() const;
  /// Returns the model that stays what this one is at a time: all schedules constant. Infinity gives
  /// the model that this one becomes.
  [[nodiscard]] Model frozen(double time) const;
};

/// A schedule of a model and its key in a case file, as in "material.line_tension".
struct NamedSchedule {
  std::string_view table;
  std::string_view key;
  const Schedule& schedule;
};

/// Returns all schedules of material and targets; absent targets are left out.
[[nodiscard]] std::vector<NamedSchedule> schedules_of(const Model& model);

/// Returns the scale that divides the error of a constraint: the modulus of its target, or the
/// scale that it declares because its target may be zero. `area` is that of the surface.
template <class Constraint>
[[nodiscard]] double error_scale(double target, double area) {
  if constexpr (requires { Constraint::error_scale(area); }) {
    return Constraint::error_scale(area);
  } else {
    return std::abs(target);
  }
}

/// Returns the places in `Constraints` of the constraints that have a target, ascending. The phase
/// difference counts only where there is a phase field.
[[nodiscard]] inline std::vector<int> active_constraints(const Model& model) {
  std::vector<int> active;
  for_each_term<Constraints>([&]<class Constraint>(std::size_t place) {
    if (model.targets[place] && (model.is_two_phase || !Constraint::needs_phase_field))
      active.push_back(static_cast<int>(place));
  });
  return active;
}

}  // namespace vesica::model
