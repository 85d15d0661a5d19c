#pragma once

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Natural units of a case. Tolerances and rates are given in them, so a run does not depend on the
/// units of length and energy of its case file. Of schedules the last value counts: it does not
/// change during a run, and it is what the equilibrium belongs to.
struct Scales {
  double length = 1;  ///< R_c (4.2), of the area target or, without one, of the start [length]
  double energy = 1;  ///< bending rigidity of phase 1 [energy]

  /// Returns the unit of the tangential damping alpha [length^2/energy].
  [[nodiscard]] double damping() const { return length * length / energy; }
  /// Returns the unit of time [length^4/energy].
  [[nodiscard]] double time() const { return length * length * length * length / energy; }
  /// Returns the unit of the L2 norm of a velocity on the surface [length^2/time].
  [[nodiscard]] double velocity_norm() const { return length * length / time(); }
  /// Returns the unit of the multiplier of the volume [energy/length^3].
  [[nodiscard]] double multiplier() const { return energy / (length * length * length); }
};

/// Returns the natural units of a model and its start.
[[nodiscard]] Scales scales_of(const model::Model& model, const State& start);

}  // namespace vesica::problem
