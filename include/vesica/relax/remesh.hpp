#pragma once

#include <Eigen/Core>
#include <optional>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Wanted length of edges at each node of the state [length], shape (N): the size field of its
/// recovered shape operator and order parameter. When it asks for more than `remesh.max_nodes`,
/// first the curvature angle grows, up to 0.5, then all edges: the energy is more sensitive to the
/// mesh in the interface.
[[nodiscard]] Eigen::VectorXd wanted_sizes(const model::Model& model, const problem::State& state,
                                           const Remesh& remesh);

/// The state on a new mesh of the same surface: positions, order parameter, curvature and rates
/// interpolated, time, damping and multipliers kept, V, A and int h(c) restored to what they were.
/// The new mesh has `remesh.max_nodes` nodes at most, unless the surface cannot do with so few.
/// Absent when the new mesh has a fold or no quality: then the old one is better.
[[nodiscard]] std::optional<problem::State> remeshed(const model::Model& model,
                                                     const problem::State& state,
                                                     const Remesh& remesh);

}  // namespace vesica::relax
