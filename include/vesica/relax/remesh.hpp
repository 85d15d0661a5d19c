#pragma once

#include <Eigen/Core>
#include <optional>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Wanted length of edges at each node of the state [length], shape (N): the size field of its
/// recovered shape operator and order parameter, enlarged to `remesh.max_nodes`.
[[nodiscard]] Eigen::VectorXd wanted_sizes(const model::Model& model, const problem::State& state,
                                           const Remesh& remesh);

/// The state on a new mesh of the same surface: positions, order parameter, curvature and rates
/// interpolated, time, damping and multipliers kept, V, A and int h(c) restored to what they were.
/// Absent when the new mesh has a fold or no quality: then the old one is better.
[[nodiscard]] std::optional<problem::State> remeshed(const model::Model& model,
                                                     const problem::State& state,
                                                     const Remesh& remesh);

}  // namespace vesica::relax
