#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Computes the wanted length of edges at each node of the state [length], shape (N): the size
/// field of its recovered shape operator and order parameter. When it asks for more than
/// `max_nodes`, first the curvature angle and the interface size grow by one factor, each up to
/// 0.5, then all edges.
[[nodiscard]] Eigen::VectorXd wanted_sizes(const model::Model& model, const problem::State& state,
                                           const adapt::SizeFieldOptions& options,
                                           double max_nodes);

/// Returns what bisection would do with each triangle of the state, as paper::marks does.
[[nodiscard]] std::vector<paper::Mark> wanted_marks(const model::Model& model,
                                                    const problem::State& state,
                                                    const paper::BisectionOptions& marking,
                                                    double max_nodes);

/// Returns the state on a new mesh of the same surface: positions, order parameter, curvature and
/// rates interpolated, time, damping and multipliers kept, V, A, int h(c) and what else the model constrains
/// restored to what they were where that does the mesh no harm. The new mesh has `remesh.max_nodes` nodes at most, unless the surface cannot do with so
/// few. Absent when the new mesh has a fold or no quality, or a conformal image less than the old
/// mesh, since then the old one is better, and when bisection finds nothing to change.
[[nodiscard]] std::optional<problem::State> remeshed(const model::Model& model,
                                                     const problem::State& state,
                                                     const Remesh& remesh);

}  // namespace vesica::relax
