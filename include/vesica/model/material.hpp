#pragma once

#include <optional>

#include "vesica/core/fields.hpp"

namespace vesica::model {

/// A material constant in phase 1 (c = +1) and phase 2 (c = -1).
struct PhasePair {
  double phase_1 = 0;
  double phase_2 = 0;
  [[nodiscard]] double difference() const { return phase_1 - phase_2; }
  friend bool operator==(const PhasePair&, const PhasePair&) = default;
};

/// Material of the membrane, (1.3) to (1.6). A single-phase vesicle uses the values of phase 1.
struct MaterialOptions {
  PhasePair bending_rigidity{1.0, 1.0};
  PhasePair spontaneous_curvature{0.0, 0.0};
  PhasePair gaussian_rigidity{0.0, 0.0};
  double line_tension = 1.0;
  double interface_width = 0.3;
  double kinetic_coefficient = 0.1;
  std::optional<double> reduced_line_tension{};
  std::optional<double> rigidity_ratio{};
  std::optional<double> saddle_splay_difference{};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"bending_rigidity", "energy", "k_kappa: [phase 1, phase 2], or one number for both",
                Rule::positive},
          self.bending_rigidity);
    visit(Field{"spontaneous_curvature", "1/length",
                "kappa_s, -2/R fits a sphere: [phase 1, phase 2], or one number"},
          self.spontaneous_curvature);
    visit(Field{"gaussian_rigidity", "energy",
                "k_g: [phase 1, phase 2], or one number (then it is topological)"},
          self.gaussian_rigidity);
    visit(Field{"line_tension", "energy/length",
                "sigma of (1.3); the sharp line energy is 4/3 sigma", Rule::non_negative},
          self.line_tension);
    visit(Field{"interface_width", "length", "epsilon of (1.3)", Rule::positive},
          self.interface_width);
    visit(Field{"kinetic_coefficient", "length",
                "omega of (1.7b): small values relax the phase field faster", Rule::positive},
          self.kinetic_coefficient);
    visit(Field{"reduced_line_tension", "-", "instead of line_tension: R_c (4/3 sigma) / k_1",
                Rule::non_negative},
          self.reduced_line_tension);
    visit(Field{"rigidity_ratio", "-", "b_r = k_2 / k_1; sets the rigidity of phase 2",
                Rule::positive},
          self.rigidity_ratio);
    visit(Field{"saddle_splay_difference", "-",
                "Delta_g = (k_g,1 - k_g,2) / k_1; sets k_g of phase 1, k_g,2 = 0"},
          self.saddle_splay_difference);
  }
};

}  // namespace vesica::model
