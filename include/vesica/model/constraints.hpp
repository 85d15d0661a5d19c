#pragma once

#include <optional>

#include "vesica/core/fields.hpp"
#include "vesica/model/schedule.hpp"

namespace vesica::model {

enum class TargetKind { initial, free, prescribed };

/// What a case says of one constraint: a number or schedule, "initial" (what the start has), or
/// "free" (no constraint).
struct Target {
  TargetKind kind = TargetKind::initial;
  Schedule schedule{};
  bool begins_at_start = false;  ///< the first value of the schedule is what the start has
  friend bool operator==(const Target&, const Target&) = default;
};

/// Constraints (2.1), (2.4), in the units of the case or in the reduced numbers of Section 4.
struct ConstraintOptions {
  Target volume{};
  Target area{};
  Target phase_difference{};
  std::optional<double> reduced_volume{};
  std::optional<double> phase_fraction{};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"volume", "length^3",
                "number, [from, to, t0, t1], { times, values, kind = \"linear\" or \"stages\" }, "
                "\"initial\" "
                "(also as the first value) or \"free\""},
          self.volume);
    visit(Field{"reduced_volume", "-",
                "instead of volume: v_r = V / (4 pi R_c^3 / 3), R_c = sqrt(A / 4 pi)",
                Rule::positive},
          self.reduced_volume);
    visit(Field{"area", "length^2", "as volume"}, self.area);
    visit(Field{"phase_difference", "length^2", "A_1 - A_2: as volume"}, self.phase_difference);
    visit(
        Field{"phase_fraction", "-", "instead of phase_difference: x_r = A_2 / A", Rule::fraction},
        self.phase_fraction);
  }
};

}  // namespace vesica::model
