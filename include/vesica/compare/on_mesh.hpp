#pragma once

#include "vesica/compare/shape_distance.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::compare {

/// Describes `other`, moved by `motion`, by the nodes of `owner`: node i of `owner` goes along its
/// normal until it meets the surface of `other`; c is interpolated there by quadratic shape
/// functions, the multipliers are those of `other`. Rates and curvature are zero. Two equilibria
/// can then be compared without the difference that the placement of their nodes makes. Throws
/// RecoverableError when a normal does not meet the surface near its node: the shapes are too far
/// apart.
[[nodiscard]] problem::State on_mesh_of(const problem::State& owner, const problem::State& other,
                                        const RigidMotion& motion);

}  // namespace vesica::compare
