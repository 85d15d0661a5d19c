#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "vesica/fem/node_graph.hpp"
#include "vesica/linalg/bordered_solver.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/dof_layout.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Values of the constrained functionals and their derivatives along the rates, in the order
/// volume, area, phase.
struct ConstraintValues {
  std::array<double, model::num_constraints> value{};
  std::array<double, model::num_constraints> rate{};
};

struct EquationContext;

/// The semi-discrete relaxation flow (Problem 3.1 with the damping of 3.4 eliminated) as a DAE
/// F(t, y, y') = 0:
///
///   equation                                                                          how many
///   (a)  int (x'.nu) chi + <dF + sum lambda_i dC_i, chi> = 0                              N
///   (b)  int grad xi : grad x + int kappa nu . xi + alpha int xi . (I - nu nu^T) x' = 0   3N
///   (d)  eps omega int c' phi + <dF + sum lambda_i dC_i, phi> = 0                         N
///   (e)  d/dt C_i + gamma (C_i - target_i) - target_i' = 0                      one a constraint
///
/// Unknowns and equations of a node stand together (DofLayout); equation order in a node: (b) x, y,
/// z, (a), (d). Every method throws RecoverableError when an element is degenerate or a value is
/// not finite.
class RelaxationProblem final : public AssembledProblem {
 public:
  /// Makes the equations on a mesh. `threads` is the number of threads of parallel_for; 0 takes all
  /// cores.
  RelaxationProblem(std::shared_ptr<const mesh::Triangulation> triangulation, model::Model model,
                    int threads);

  [[nodiscard]] const DofLayout& layout() const { return layout_; }
  [[nodiscard]] const model::Model& model() const override { return model_; }
  [[nodiscard]] int block_size() const override { return layout_.block_size(); }
  [[nodiscard]] Eigen::Index num_nodal() const override { return layout_.num_nodal(); }
  [[nodiscard]] Eigen::Index num_multipliers() const override { return layout_.num_multipliers(); }
  [[nodiscard]] Eigen::VectorXd initial_values(const State& start) const override;
  [[nodiscard]] Unknowns unknowns(const State& state) const override;
  [[nodiscard]] Fields values(double, const Eigen::VectorXd& y) const override {
    return layout_.unpack(y);
  }
  [[nodiscard]] Fields rates(const Eigen::VectorXd&, const Eigen::VectorXd& y_rate) const override {
    return layout_.unpack(y_rate);
  }
  [[nodiscard]] Eigen::VectorXd differential_mask() const override {
    return layout_.differential_mask();
  }
  [[nodiscard]] Eigen::VectorXd units(const Scales& scales) const override;

  [[nodiscard]] Eigen::VectorXd residual(const EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& y_rate) const override;

  [[nodiscard]] linalg::BorderedMatrix make_matrix() const override;

  /// Computes the Jacobian at (t, y, y'), exact but for the recovered shape operator Q_h, which is
  /// nonlocal: its value is used, its derivative is that of the elementwise shape operator.
  void jacobian(const EquationSettings& settings, const JacobianWeights& weights, double time,
                const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                linalg::BorderedMatrix& matrix) const override;

  /// Computes the values of all three functionals (the phase difference is 0 for a single-phase
  /// vesicle) and their exact rates.
  [[nodiscard]] ConstraintValues constraints(const Eigen::VectorXd& y,
                                             const Eigen::VectorXd& y_rate) const;

 private:
  template <int Block>
  void assemble_block(const EquationContext& context, const JacobianWeights& weights,
                      linalg::SparseMatrix& matrix) const;
  template <int Block>
  void assemble_columns(const EquationContext& context, Eigen::MatrixXd& columns) const;
  void assemble_rows(const EquationSettings& settings, const JacobianWeights& weights,
                     const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                     Eigen::MatrixXd& rows) const;

  std::shared_ptr<const mesh::Triangulation> triangulation_;
  model::Model model_;
  fem::NodeGraph graph_;
  DofLayout layout_;
  int threads_;
};

}  // namespace vesica::problem
