#pragma once

#include <Eigen/Core>

#include "vesica/mesh/triangulation.hpp"
#include "vesica/phase/initial_phase.hpp"

namespace vesica::phase {

/// How a level l becomes an order parameter: l itself between -1 and 1, or tanh(l).
enum class PhaseProfile { clip, tanh };

/// An initial phase before it is shifted: c = profile(values + shift) at the nodes. Levels of the
/// tanh profile are signed distances to the interface over epsilon, positive in phase 1.
struct PhaseLevels {
  Eigen::VectorXd values;
  PhaseProfile profile = PhaseProfile::clip;
};

/// Levels of every kind but `file`. Throws ConfigError for options that describe no phase field.
[[nodiscard]] PhaseLevels phase_levels(const PhaseOptions& options, const mesh::Surface& surface,
                                       double interface_width);

}  // namespace vesica::phase
