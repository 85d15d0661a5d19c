#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::problem {

/// Number of multipliers mu of the rigid gauge.
inline constexpr Eigen::Index num_rigid = 6;

/// Arguments of the equations of the multipliers over a normal graph.
struct BorderArguments {
  double time = 0;
  const ConstraintEvaluation& constraints;
  const EnergyRates& rates;
  Eigen::VectorXd displacements;  ///< d, shape (N)
  Eigen::VectorXd speeds;         ///< d', shape (N)
  Eigen::VectorXd gauge;          ///< mu, shape (6)
};

/// Computes the equations of the active constraints, then of the gauge: d/dt C_i + gamma (C_i -
/// target_i) - target_i' and d/dt g_k + gamma g_k, or their original form; mu_k where g_k is empty.
[[nodiscard]] Eigen::VectorXd border_residual(const model::Model& model, const NormalGraph& graph,
                                              const EquationSettings& settings,
                                              const BorderArguments& at);

/// Returns the factor of the columns of the border in its rows.
[[nodiscard]] inline double border_row_factor(const EquationSettings& settings,
                                              const JacobianWeights& weights) {
  return settings.form == ConstraintForm::original
             ? weights.value
             : weights.value * settings.constraint_rate + weights.rate;
}

/// Returns sum_k field(i, k) directions(i, k), the component along the direction of each node.
[[nodiscard]] inline Eigen::VectorXd along(const mesh::Positions& field,
                                           const mesh::Positions& directions) {
  return field.cwiseProduct(directions).rowwise().sum();
}

/// A new reference, the present surface, with nodal fields on its nodes.
struct RenewedGraph {
  NormalGraph graph;
  double quality = 0;  ///< (3.5) of its mesh
  Eigen::MatrixXd nodal;
};

/// Returns a new graph when a normal has turned so far that its cosine with the direction of the
/// node is below 0.85, or when the quality (3.5) of the mesh has fallen below 0.3 and by a quarter:
/// then the nodes are first redistributed on the surface and `nodal`, shape (N, any), interpolated.
[[nodiscard]] std::optional<RenewedGraph> renewed(
    const std::shared_ptr<const mesh::Triangulation>& triangulation, const NormalGraph& graph,
    const Eigen::VectorXd& displacements, double quality_of_reference,
    const Eigen::MatrixXd& nodal);

}  // namespace vesica::problem
