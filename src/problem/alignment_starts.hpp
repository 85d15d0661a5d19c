#pragma once

#include <vector>

#include "surface_probe.hpp"
#include "vesica/problem/shape_distance.hpp"

namespace vesica::problem {

/// Motions of `second` that may lie near the best one: none, node onto node for the same
/// connectivity, and axes of inertia onto axes of inertia in all orientations. About an axis of
/// which the two others cannot be told apart (variances within 5 %), in eighths of a turn.
[[nodiscard]] std::vector<RigidMotion> alignment_starts(const SurfaceProbe& first,
                                                        const SurfaceProbe& second);

}  // namespace vesica::problem
