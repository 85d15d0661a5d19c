#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "graph_equations.hpp"

namespace vesica::problem {

/// What belongs to (t, y) and costs something: the moment, and the constraints with their
/// gradients.
struct ReducedPoint {
  double time = 0;
  Eigen::VectorXd y;
  EnergyFields fields;  ///< with p at the maximum of the energy
  fem::MassMatrix mass;
  ConstraintEvaluation constraints;
};

/// What all products of a Jacobian at one point share.
struct ReducedLinearisation {
  EquationSettings settings;
  EnergyRates rates;
  Eigen::MatrixXd columns;  ///< gradients of active constraints, then the gauge, (num_nodal, m)
  Eigen::MatrixXd changes;  ///< rates of the gradients of the constraints, or empty
};

/// The equations of VariationalProblem with the moment p eliminated: it is the maximiser of the
/// energy at every x and c. Unknowns: the displacements d of all nodes, then c of all nodes (two
/// phases), then lambda and mu. The Jacobian is dense, because p depends on all nodes; its products
/// with vectors are exact up to the tolerance of the solve for the change of p.
class ReducedProblem final : public FlowProblem {
 public:
  /// Makes the equations on a mesh, with `positions`, shape (N, 3), as the reference of the graph.
  ReducedProblem(std::shared_ptr<const mesh::Triangulation> triangulation, model::Model model,
                 const mesh::Positions& positions, int threads);

  [[nodiscard]] const model::Model& model() const override { return energy_.model(); }
  [[nodiscard]] const EnergyProblem& energy_problem() const { return energy_; }
  [[nodiscard]] const NormalGraph& graph() const { return graph_; }
  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] Eigen::Index num_nodes() const { return graph_.reference.rows(); }
  [[nodiscard]] int block_size() const override { return model().is_two_phase ? 2 : 1; }
  [[nodiscard]] Eigen::Index num_nodal() const override { return num_nodes() * block_size(); }
  [[nodiscard]] Eigen::Index num_multipliers() const override;

  [[nodiscard]] Eigen::VectorXd initial_values(const State& start) const override;
  [[nodiscard]] Unknowns unknowns(const State& state) const override;
  [[nodiscard]] Fields values(double time, const Eigen::VectorXd& y) const override {
    return values(point(time, y));
  }
  [[nodiscard]] Fields rates(const Eigen::VectorXd& y,
                             const Eigen::VectorXd& y_rate) const override;
  [[nodiscard]] Eigen::VectorXd differential_mask() const override;
  [[nodiscard]] Eigen::VectorXd units(const Scales& scales) const override;
  [[nodiscard]] std::optional<model::EnergyParts> energy(double time,
                                                         const Eigen::VectorXd& y) const override {
    return energy_.energy(point(time, y).fields);
  }
  [[nodiscard]] Eigen::VectorXd residual(const EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& y_rate) const override {
    return residual(settings, point(time, y), y_rate);
  }
  bool renew_coordinates(Eigen::VectorXd& y, Eigen::VectorXd& y_rate) override;

  /// Computes what belongs to (t, y). `moment`, shape (N, 3) or empty, is a first guess of p.
  [[nodiscard]] ReducedPoint point(double time, const Eigen::VectorXd& y,
                                   const mesh::Positions& moment = {}) const;
  [[nodiscard]] Fields values(const ReducedPoint& point) const;
  [[nodiscard]] Eigen::VectorXd residual(const EquationSettings& settings,
                                         const ReducedPoint& point,
                                         const Eigen::VectorXd& y_rate) const;
  [[nodiscard]] ReducedLinearisation linearise(const EquationSettings& settings,
                                               const ReducedPoint& point,
                                               const Eigen::VectorXd& y_rate) const;
  /// Computes the product of the Jacobian (value dF/dy + rate dF/dy') with v, shape (size()).
  [[nodiscard]] Eigen::VectorXd product(const ReducedPoint& point,
                                        const ReducedLinearisation& there,
                                        const JacobianWeights& weights,
                                        const Eigen::VectorXd& v) const;
  /// Computes the rows of the multipliers in the Jacobian, shape (num_multipliers(), num_nodal()).
  [[nodiscard]] Eigen::MatrixXd border_rows(const ReducedLinearisation& there,
                                            const JacobianWeights& weights) const;

 private:
  [[nodiscard]] Multipliers multipliers(const Eigen::VectorXd& y) const;
  [[nodiscard]] Eigen::VectorXd order_parameter(const Eigen::VectorXd& y) const;
  [[nodiscard]] EnergyRates energy_rates(const Eigen::VectorXd& y_rate) const;
  [[nodiscard]] Eigen::MatrixXd constraint_columns(const ConstraintEvaluation& constraints) const;

  std::shared_ptr<const mesh::Triangulation> triangulation_;
  EnergyProblem energy_;
  NormalGraph graph_;
  double quality_of_reference_;
  std::vector<int> active_;  // the constraints that have a target
  int threads_;
};

}  // namespace vesica::problem
