#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "vesica/fem/node_graph.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/linalg/sparse_matrix.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/dof_layout.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::paper {

/// Parameters of one step of the fully discrete scheme.
struct SemiImplicitSettings {
  double time_step = 0;  ///< tau [time]
  double damping = 0;    ///< alpha of (3.4) [length^2/energy]
  double time = 0;       ///< t^{m+1}, at which the material is taken [time]
};

/// Whether the tangential velocity is kept in the fields beta_1, beta_2 of (3.4) or eliminated as
/// in equation (b) of RelaxationProblem.
enum class TangentialVelocity { fields, eliminated };

/// One step of the fully discrete scheme: the two blocks of J^m (A.1a), which do not couple, and
/// their right-hand sides (A.1b) to (A.1e). Column 0 belongs to r^m, column 1 + i to d_i^m of the
/// i-th active constraint.
struct SemiImplicitSystem {
  linalg::SparseMatrix geometry;   ///< x, y, z, kappa (, beta_1, beta_2) node by node
  linalg::SparseMatrix phase;      ///< c; empty for a single-phase vesicle
  Eigen::MatrixXd geometry_sides;  ///< shape (N block, 1 + active constraints)
  Eigen::MatrixXd phase_sides;     ///< shape (N, 1 + active constraints)
};

/// r^m and d_i^m of (A.1), columns as in SemiImplicitSystem: y^{m+1} = r - sum lambda_i d_i (A.2).
struct SemiImplicitSolution {
  Eigen::MatrixXd geometry;
  Eigen::MatrixXd phase;
};

/// The fully discrete relaxation flow of the paper, Problem 3.2 with the damping (3.4): highest
/// order terms and multipliers implicit, geometry and the rest from the last step. Mended here:
///   * (A.1a) prints +tau C where (3.3a) has -tau C, which makes the matrix quasi-definite;
///   * (A.1b) prints t_1 twice, the second is t_2;
///   * t_mu carries the factor alpha of (A.1a), and no tau.
/// beta_mu is stored as sqrt(tau alpha) beta_mu: the matrix stays symmetric and its rows comparable
/// for all alpha. Every energy of the model takes part: what is not named in C and J of 2.4 is
/// explicit.
class SemiImplicitProblem {
 public:
  /// Makes the problem on a mesh. `threads` is the number of threads of parallel_for; 0 takes all
  /// cores.
  SemiImplicitProblem(std::shared_ptr<const mesh::Triangulation> triangulation, model::Model model,
                      TangentialVelocity tangential, int threads);

  /// Returns the number of unknowns of a node in the geometry block: 6 with tangential fields, 4
  /// without.
  [[nodiscard]] int block_size() const;
  [[nodiscard]] const problem::DofLayout& layout() const { return layout_; }
  [[nodiscard]] const model::Model& model() const { return model_; }

  /// Makes a system with the pattern that `assemble` fills, values zero.
  [[nodiscard]] SemiImplicitSystem make_system() const;

  /// Recovers the shape operator Q_h^m of 3.3.
  [[nodiscard]] fem::NodalShapeOperator shape_operator(const mesh::Positions& positions) const;

  /// Computes matrices and right-hand sides for the step that starts with `fields`. Throws
  /// RecoverableError when one of them is not finite.
  void assemble(const SemiImplicitSettings& settings, const problem::Fields& fields,
                const fem::NodalShapeOperator& shape_operator, SemiImplicitSystem& system) const;

  /// Returns the fields (A.2) at multipliers of the active constraints.
  [[nodiscard]] problem::Fields fields_at(const SemiImplicitSolution& solution,
                                          const Eigen::VectorXd& multipliers) const;

  /// Computes the errors C_i - target_i of the functionals (2.2), (2.3) of the active constraints
  /// with the targets at `time`.
  [[nodiscard]] Eigen::VectorXd constraint_errors(const problem::Fields& fields, double time) const;
  /// Returns the scales that the errors are divided by: |target|, and the area where the phase
  /// difference has the target 0.
  [[nodiscard]] Eigen::VectorXd constraint_scales(const problem::Fields& fields, double time) const;
  /// Computes H of appendix B, the approximate derivative of the errors with respect to the
  /// multipliers, row: constraint, column: multiplier.
  [[nodiscard]] Eigen::MatrixXd constraint_slopes(const problem::Fields& fields,
                                                  const SemiImplicitSolution& solution) const;

 private:
  void gather_matrices(const std::vector<double>& pairs, double tangential_scale,
                       SemiImplicitSystem& system) const;
  void gather_sides(const std::vector<double>& local, SemiImplicitSystem& system) const;
  /// Computes volume, area and phase difference.
  [[nodiscard]] std::array<double, model::num_constraints> functionals(
      const problem::Fields& fields) const;

  std::shared_ptr<const mesh::Triangulation> triangulation_;
  model::Model model_;
  fem::NodeGraph graph_;
  problem::DofLayout layout_;
  TangentialVelocity tangential_;
  int threads_;
};

}  // namespace vesica::paper
