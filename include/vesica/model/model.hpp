#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "vesica/model/area.hpp"
#include "vesica/model/bending_energy.hpp"
#include "vesica/model/constraints.hpp"
#include "vesica/model/gaussian_energy.hpp"
#include "vesica/model/line_energy.hpp"
#include "vesica/model/material.hpp"
#include "vesica/model/phase_difference.hpp"
#include "vesica/model/volume.hpp"

namespace vesica::model {

/// The energies of (1.6). A new term is a type like these, named here.
using Energies = std::tuple<BendingEnergy, GaussianEnergy, LineEnergy>;

/// The constrained functionals of (2.2), (2.3), in the order of `Targets` and of the multipliers.
using Constraints = std::tuple<Volume, Area, PhaseDifference>;
inline constexpr int num_constraints = std::tuple_size_v<Constraints>;

/// Targets of the active constraints; an absent one leaves its quantity free.
struct Targets {
  std::optional<Schedule> volume;            ///< [length^3]
  std::optional<Schedule> area;              ///< [length^2]
  std::optional<Schedule> phase_difference;  ///< A_1 - A_2 [length^2]

  /// The same in the order of `Constraints`.
  [[nodiscard]] std::array<std::optional<Schedule>, num_constraints> in_order() const {
    return {volume, area, phase_difference};
  }
};

/// The terms of the energy at one time.
struct Physics {
  Material material;
  bool is_two_phase = true;
};

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

/// Places in `Constraints` of those that have a target, ascending; the phase difference counts only
/// where there is a phase field.
[[nodiscard]] inline std::vector<int> active_constraints(const Model& model) {
  const auto targets = model.targets.in_order();
  std::vector<int> active;
  int place = 0;
  const auto add = [&]<class Constraint>(const Constraint&) {
    if (targets[static_cast<std::size_t>(place)] &&
        (model.is_two_phase || !Constraint::needs_phase_field))
      active.push_back(place);
    ++place;
  };
  std::apply([&](const auto&... constraint) { (add(constraint), ...); }, Constraints{});
  return active;
}

}  // namespace vesica::model
