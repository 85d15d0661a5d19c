#pragma once

#include <Eigen/Core>
#include <memory>

#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::problem {

/// The constrained gradient flow of the discrete energy E_h over a normal graph
/// x_i = X_i + d_i n_i, with L = E_h + sum lambda_i C_i + sum mu_k g_k, g the rigid gauge:
///
///   dE_h/dp = 0                                             3N  equations (the maximiser p)
///   int (x'.nu) (n_i.nu) phi_i + dL/dd_i = 0                 N
///   eps omega int c' phi_i + dL/dc_i = 0                     N  (two phases)
///   d/dt C_i + gamma (C_i - target_i) - target_i' = 0       one a constraint
///   d/dt g_k + gamma g_k = 0                                 6  (mu_k = 0 where g_k is empty)
///
/// Unknowns of a node in the order p, d, c; then lambda of the active constraints, then mu. Along
/// solutions d/dt E_h = -||x'.nu||^2 - eps omega ||c'||^2 - sum lambda_i C_i'. The Jacobian is
/// exact and its part for y symmetric. `EquationSettings::damping` has no meaning here.
class VariationalProblem final : public AssembledProblem {
 public:
  /// Makes the equations on a mesh, with `positions`, shape (N, 3), as the reference of the graph.
  /// `threads` is the number of threads of parallel_for; 0 takes all cores.
  VariationalProblem(std::shared_ptr<const mesh::Triangulation> triangulation, model::Model model,
                     const mesh::Positions& positions, int threads);

  [[nodiscard]] const model::Model& model() const override { return energy_.model(); }
  [[nodiscard]] const EnergyProblem& energy_problem() const { return energy_; }
  [[nodiscard]] const NormalGraph& graph() const { return graph_; }
  /// Returns the displacements d, shape (N), that are in a vector of the unknowns.
  [[nodiscard]] Eigen::VectorXd displacements(const Eigen::VectorXd& y) const;
  [[nodiscard]] int block_size() const override { return model().is_two_phase ? 5 : 4; }
  [[nodiscard]] Eigen::Index num_nodal() const override;
  [[nodiscard]] Eigen::Index num_multipliers() const override;

  [[nodiscard]] Eigen::VectorXd initial_values(const State& start) const override;
  [[nodiscard]] Unknowns unknowns(const State& state) const override;
  [[nodiscard]] Fields values(double time, const Eigen::VectorXd& y) const override;
  [[nodiscard]] Fields rates(const Eigen::VectorXd& y,
                             const Eigen::VectorXd& y_rate) const override;
  [[nodiscard]] Eigen::VectorXd differential_mask() const override;
  [[nodiscard]] Eigen::VectorXd units(const Scales& scales) const override;
  [[nodiscard]] std::optional<model::EnergyParts> energy(double time,
                                                         const Eigen::VectorXd& y) const override;
  [[nodiscard]] Eigen::VectorXd residual(const EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& y_rate) const override;
  [[nodiscard]] linalg::BorderedMatrix make_matrix() const override;
  void jacobian(const EquationSettings& settings, const JacobianWeights& weights, double time,
                const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                linalg::BorderedMatrix& matrix) const override;
  /// Takes a new reference when a normal has turned so far that its cosine with the direction of
  /// the node is below 0.85, or when the quality (3.5) of the mesh has fallen below 0.3 and by a
  /// quarter: then the nodes are first redistributed on the surface, and c, p and the rates
  /// interpolated.
  bool renew_coordinates(Eigen::VectorXd& y, Eigen::VectorXd& y_rate) override;

 private:
  [[nodiscard]] EnergyFields fields(double time, const Eigen::VectorXd& y) const;
  [[nodiscard]] EnergyRates energy_rates(const Eigen::VectorXd& y_rate) const;
  [[nodiscard]] Multipliers multipliers(const Eigen::VectorXd& y) const;
  /// Returns the component of that number of every node.
  [[nodiscard]] Eigen::VectorXd component(const Eigen::VectorXd& y, Eigen::Index component) const;
  [[nodiscard]] Eigen::MatrixXd constraint_columns(const ConstraintEvaluation& constraints) const;

  [[nodiscard]] Eigen::MatrixXd as_rows(const Eigen::VectorXd& y) const;

  std::shared_ptr<const mesh::Triangulation> shared_triangulation_;
  EnergyProblem energy_;
  NormalGraph graph_;
  double quality_of_reference_;
  std::vector<int> active_;  // the constraints that have a target
};

}  // namespace vesica::problem
