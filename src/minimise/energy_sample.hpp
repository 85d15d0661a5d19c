#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/normal_graph.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::minimise {

/// Energy and constraints with their derivatives at one surface and phase field.
struct EnergySample {
  problem::EnergyFields fields;
  model::EnergyParts energy;
  problem::EnergyFields gradient;  ///< of the energy alone
  problem::ConstraintEvaluation constraints;
};

/// Computes energy and constraints with their derivatives. Throws RecoverableError for a degenerate
/// surface.
[[nodiscard]] EnergySample sample_energy(const problem::EnergyProblem& problem,
                                         const mesh::Positions& positions,
                                         const Eigen::VectorXd& order_parameter);

/// Returns the derivative with respect to the unknowns u = (d, c) of a normal graph, shape (N) or
/// (2N), from those with respect to the positions and, unless empty, the order parameter.
[[nodiscard]] Eigen::VectorXd along_graph(const problem::NormalGraph& graph,
                                          const mesh::Positions& positions,
                                          const Eigen::VectorXd& order_parameter,
                                          bool is_two_phase);

/// Returns the positions x = X + d n that belong to the unknowns u = (d, c).
[[nodiscard]] mesh::Positions positions_of(const problem::NormalGraph& graph,
                                           const Eigen::VectorXd& unknowns);
/// Returns the order parameter that is in the unknowns u = (d, c), shape (0) for a single phase.
[[nodiscard]] Eigen::VectorXd order_parameter_of(const problem::NormalGraph& graph,
                                                 const Eigen::VectorXd& unknowns);

/// The active constraints C_i = target_i of a case, in the order volume, area, phase difference.
class ConstraintSet {
 public:
  /// Makes the set. Throws ConfigError for a target that changes in time.
  ConstraintSet(const model::Model& model, const problem::Scales& scales);

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(active_.size()); }
  /// Returns C_i - target_i of the active constraints.
  [[nodiscard]] Eigen::VectorXd errors(const problem::ConstraintEvaluation& evaluation) const;
  /// Returns the units R_c^3, R_c^2, R_c^2 of the active constraints.
  [[nodiscard]] const Eigen::VectorXd& units() const { return units_; }
  /// Returns the largest error relative to the target (of the phase difference: to the area).
  [[nodiscard]] double largest_error(const problem::ConstraintEvaluation& evaluation) const;
  [[nodiscard]] std::string worst_name(const problem::ConstraintEvaluation& evaluation) const;
  /// Returns the derivatives with respect to the unknowns of a graph, one column for each
  /// constraint.
  [[nodiscard]] Eigen::MatrixXd gradients(const problem::NormalGraph& graph,
                                          const problem::ConstraintEvaluation& evaluation,
                                          bool is_two_phase) const;
  /// Returns the derivative of E + sum lambda_i C_i with respect to the unknowns of a graph.
  [[nodiscard]] Eigen::VectorXd lagrangian_gradient(const problem::NormalGraph& graph,
                                                    const EnergySample& sample,
                                                    const Eigen::VectorXd& multipliers,
                                                    bool is_two_phase) const;
  [[nodiscard]] model::PerConstraint named(const Eigen::VectorXd& multipliers) const;
  /// Returns the multipliers of all constraints, 0 for those that are not active.
  [[nodiscard]] problem::Multipliers all(const Eigen::VectorXd& multipliers) const;

 private:
  [[nodiscard]] Eigen::VectorXd relative_errors(
      const problem::ConstraintEvaluation& evaluation) const;

  std::vector<std::size_t> active_;
  Eigen::VectorXd targets_;
  Eigen::VectorXd units_;
};

}  // namespace vesica::minimise
