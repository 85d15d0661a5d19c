#pragma once

#include <array>
#include <optional>

namespace vesica::model {

/// Energy by parts [energy]; a single-phase vesicle has no line energy.
struct EnergyParts {
  double bending = 0;
  double gaussian = 0;  ///< int k_g(c) g with g = (kappa^2 - |Q|^2)/2, the energy in (1.6); (4.3)
                        ///< lacks the factor 1/2
  std::optional<double> line;
  [[nodiscard]] double total() const { return bending + gaussian + line.value_or(0.0); }
};

/// One value for each constraint; a constraint that is left free has none.
/// Multipliers: volume [energy/length^3], area and phase [energy/length^2], signs as in (1.7a):
/// dF/dV = -volume.
struct PerConstraint {
  std::optional<double> volume;
  std::optional<double> area;
  std::optional<double> phase;

  /// The same in the order of model::Constraints, and back.
  [[nodiscard]] std::array<std::optional<double>, 3> in_order() const {
    return {volume, area, phase};
  }
  [[nodiscard]] static PerConstraint from(const std::array<std::optional<double>, 3>& values) {
    return {values[0], values[1], values[2]};
  }
};

}  // namespace vesica::model
