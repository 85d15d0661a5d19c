#pragma once

#include <optional>
#include <tuple>

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
  std::optional<Ramp> volume;            ///< [length^3]
  std::optional<Ramp> area;              ///< [length^2]
  std::optional<Ramp> phase_difference;  ///< A_1 - A_2 [length^2]
};

/// Which physics: the material, whether there is a phase field, and the constraints.
struct Model {
  MaterialOptions material;
  bool is_two_phase = true;
  Targets targets;
};

}  // namespace vesica::model
