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

/// The terms of the energy at one time.
struct Physics {
  Material material;
  bool is_two_phase = true;
};

/// Whether a term takes part: those of the phase field only where there is one, and those that can
/// tell only where they are present.
template <class Term>
[[nodiscard]] bool takes_part(const Physics& physics) {
  if (Term::needs_phase_field && !physics.is_two_phase) return false;
  if constexpr (requires { Term::is_present(physics.material); }) {
    return Term::is_present(physics.material);
  } else {
    return true;
  }
}

/// Which physics: the material, whether there is a phase field, and the constraints. Material and
/// targets may change in time.
struct Model {
  MaterialOptions material;
  bool is_two_phase = true;
  Targets targets;

  [[nodiscard]] Physics at(double time) const { return {material.at(time), is_two_phase}; }
  /// The first time after `time` at which a material parameter or a target has a kink or jumps;
  /// infinity when there is none.
  [[nodiscard]] double next_kink(double time) const;
  [[nodiscard]] bool jumps_at(double time) const;
  /// The last kink or jump; minus infinity when nothing changes.
  [[nodiscard]] double rests_after() const;
};

/// A schedule of a model and its key in a case file, as in "material.line_tension".
struct NamedSchedule {
  std::string_view table;
  std::string_view key;
  const Schedule& schedule;
};

/// All schedules of material and targets; absent targets are left out.
[[nodiscard]] std::vector<NamedSchedule> schedules_of(const Model& model);

/// What the error of a constraint is measured by: the modulus of its target, or the scale that it
/// declares because its target may be zero. `area` is that of the surface.
template <class Constraint>
[[nodiscard]] double error_scale(double target, double area) {
  if constexpr (requires { Constraint::error_scale(area); }) {
    return Constraint::error_scale(area);
  } else {
    return std::abs(target);
  }
}

/// Places in `Constraints` of those that have a target, ascending; the phase difference counts only
/// where there is a phase field.
[[nodiscard]] inline std::vector<int> active_constraints(const Model& model) {
  std::vector<int> active;
  std::size_t place = 0;
  for_each_term<Constraints>([&]<class Constraint>() {
    if (model.targets[place] && (model.is_two_phase || !Constraint::needs_phase_field))
      active.push_back(static_cast<int>(place));
    ++place;
  });
  return active;
}

}  // namespace vesica::model
