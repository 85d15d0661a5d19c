#pragma once

#include <vector>

#include "measure/surface_probe.hpp"
#include "vesica/compare/shape_distance.hpp"

namespace vesica::compare {

/// Motions of `second` that may lie near the best one: none, node onto node for the same
/// connectivity, and axes of inertia onto axes of inertia in all orientations. About an axis of
/// which the two others cannot be told apart (variances within 5 %), in eighths of a turn.
[[nodiscard]] std::vector<RigidMotion> alignment_starts(const measure::SurfaceProbe& first,
                                                        const measure::SurfaceProbe& second);

}  // namespace vesica::compare
