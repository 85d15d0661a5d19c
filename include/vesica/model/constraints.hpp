#pragma once

#include <optional>

#include "vesica/core/fields.hpp"

namespace vesica::model {

/// Target of a constraint: `from` up to `start`, linear in between, `to` from `end` on. A constant
/// has from == to.
struct Ramp {
  double from = 0;
  double to = 0;
  double start = 0;  ///< [time]
  double end = 0;    ///< [time]

  [[nodiscard]] static Ramp constant(double value) { return {value, value, 0, 0}; }
  [[nodiscard]] bool is_constant() const { return from == to; }
  [[nodiscard]] double value(double time) const;
  /// Right derivative [per time].
  [[nodiscard]] double rate(double time) const;
};

enum class TargetKind { initial, free, prescribed };

/// What a case says of one constraint: a number or ramp, "initial" (what the start has), or "free"
/// (no constraint).
struct Target {
  TargetKind kind = TargetKind::initial;
  Ramp ramp;
  friend bool operator==(const Target& a, const Target& b) {
    return a.kind == b.kind && a.ramp.from == b.ramp.from && a.ramp.to == b.ramp.to &&
           a.ramp.start == b.ramp.start && a.ramp.end == b.ramp.end;
  }
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
                "number, [from, to, t0, t1] (linear in time), \"initial\" or \"free\""},
          self.volume);
    visit(Field{"reduced_volume", "-",
                "instead of volume: v_r = V / (4 pi R_c^3 / 3), R_c = sqrt(A / 4 pi)",
                Rule::positive},
          self.reduced_volume);
    visit(Field{"area", "length^2", "number, [from, to, t0, t1], \"initial\" or \"free\""},
          self.area);
    visit(Field{"phase_difference", "length^2",
                "A_1 - A_2: number, [from, to, t0, t1], \"initial\" or \"free\""},
          self.phase_difference);
    visit(
        Field{"phase_fraction", "-", "instead of phase_difference: x_r = A_2 / A", Rule::fraction},
        self.phase_fraction);
  }
};

}  // namespace vesica::model
