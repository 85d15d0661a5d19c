#pragma once

#include <array>
#include <optional>

#include "vesica/core/fields.hpp"
#include "vesica/model/schedule.hpp"

namespace vesica::model {

/// A material constant in phase 1 (c = +1) and phase 2 (c = -1).
struct PhasePair {
  double phase_1 = 0;
  double phase_2 = 0;
  [[nodiscard]] double difference() const { return phase_1 - phase_2; }
  friend bool operator==(const PhasePair&, const PhasePair&) = default;
};

/// A material constant of each phase that may change in time.
struct PhaseSchedules {
  Schedule phase_1;
  Schedule phase_2;
  [[nodiscard]] PhasePair at(double time) const {
    return {phase_1.value(time), phase_2.value(time)};
  }
  [[nodiscard]] std::array<Schedule, 2> parts() const { return {phase_1, phase_2}; }
  friend bool operator==(const PhaseSchedules&, const PhaseSchedules&) = default;
};

/// Material of the membrane at one time, (1.3) to (1.6). A single-phase vesicle uses the values of
/// phase 1.
struct Material {
  PhasePair bending_rigidity{1.0, 1.0};       ///< k_kappa [energy]
  PhasePair spontaneous_curvature{0.0, 0.0};  ///< kappa_s [1/length]
  PhasePair gaussian_rigidity{0.0, 0.0};      ///< k_g [energy]
  PhasePair surface_tension{0.0, 0.0};        ///< tau [energy/length^2]
  double line_tension = 1.0;                  ///< sigma [energy/length]
  double interface_width = 0.3;               ///< epsilon [length]
  double kinetic_coefficient = 0.1;           ///< omega [length]
};

/// Material of a case: constants or quantities that change in time, some of them in reduced
/// numbers.
struct MaterialOptions {
  PhaseSchedules bending_rigidity{1.0, 1.0};
  PhaseSchedules spontaneous_curvature{0.0, 0.0};
  PhaseSchedules gaussian_rigidity{0.0, 0.0};
  PhaseSchedules surface_tension{0.0, 0.0};
  Schedule line_tension = 1.0;
  Schedule interface_width = 0.3;
  Schedule kinetic_coefficient = 0.1;
  std::optional<double> reduced_line_tension{};
  std::optional<double> rigidity_ratio{};
  std::optional<double> saddle_splay_difference{};

  /// Returns the material at a time. Reduced numbers must have been resolved by
  /// `resolved_material`. Does not allocate.
  [[nodiscard]] Material at(double time) const {
    return {bending_rigidity.at(time),      spontaneous_curvature.at(time),
            gaussian_rigidity.at(time),     surface_tension.at(time),
            line_tension.value(time),       interface_width.value(time),
            kinetic_coefficient.value(time)};
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(
        Field{"bending_rigidity", "energy",
              "k_kappa: [phase 1, phase 2], or one for both; each a number, [from, to, t0, t1] or "
              "{ times, values, kind }",
              Rule::positive},
        self.bending_rigidity);
    visit(Field{"spontaneous_curvature", "1/length",
                "kappa_s, -2/R fits a sphere: as bending_rigidity"},
          self.spontaneous_curvature);
    visit(Field{"gaussian_rigidity", "energy",
                "k_g: as bending_rigidity; equal in both phases it is topological"},
          self.gaussian_rigidity);
    visit(Field{"surface_tension", "energy/length^2",
                "tau of the energy int tau(c): as bending_rigidity; at fixed area and phase "
                "difference it shifts their multipliers alone"},
          self.surface_tension);
    visit(Field{"line_tension", "energy/length",
                "sigma of (1.3); the sharp line energy is 4/3 sigma; may change in time",
                Rule::non_negative},
          self.line_tension);
    visit(
        Field{"interface_width", "length", "epsilon of (1.3); may change in time", Rule::positive},
        self.interface_width);
    visit(Field{"kinetic_coefficient", "length",
                "omega of (1.7b): small values relax the phase field faster; may change in time",
                Rule::positive},
          self.kinetic_coefficient);
    visit(Field{"reduced_line_tension", "-",
                "instead of line_tension: R_c (4/3 sigma) / k_1, at all times", Rule::non_negative},
          self.reduced_line_tension);
    visit(Field{"rigidity_ratio", "-", "b_r = k_2 / k_1; sets the rigidity of phase 2",
                Rule::positive},
          self.rigidity_ratio);
    visit(Field{"saddle_splay_difference", "-",
                "Delta_g = (k_g,1 - k_g,2) / k_1; sets k_g of phase 1, k_g,2 = 0"},
          self.saddle_splay_difference);
  }
  /// Refuses a quantity that is given both in units and as a reduced number. Throws ConfigError.
  void check_together() const;
};

}  // namespace vesica::model
