#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "vesica/fem/mass_matrix.hpp"
#include "vesica/fem/node_graph.hpp"
#include "vesica/model/model.hpp"
#include "vesica/model/per_term.hpp"
#include "vesica/problem/flow_problem.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Arguments of the discrete energy, or derivatives of it with respect to them.
struct EnergyFields {
  mesh::Positions positions;        ///< x, shape (N, 3) [length]
  mesh::Positions moment;           ///< p = -k_kappa (kappa - kappa_s) nu, (N, 3) [energy/length]
  Eigen::VectorXd order_parameter;  ///< c, shape (N), or (0) for a single-phase vesicle
  double time = 0;                  ///< time at which the material is taken [time]
};

/// Rates of the gradient flow, whose terms are added to the derivative of the energy. Empty arrays
/// add nothing.
struct EnergyRates {
  mesh::Positions velocity;         ///< x', shape (N, 3)
  Eigen::VectorXd order_parameter;  ///< c', shape (N)
};

/// Multipliers of volume, area and phase difference in the Lagrangian E + sum lambda_i C_i, signs
/// as in (1.7a).
using Multipliers = std::array<double, model::num_constraints>;

/// Values and exact gradients of the constrained functionals, in the order of model::Constraints; 0
/// for those of the phase field of a single-phase vesicle.
struct ConstraintEvaluation {
  std::array<double, model::num_constraints> values{};
  std::array<mesh::Positions, model::num_constraints> positions;
  /// With respect to c, shape (N); empty for a single-phase vesicle.
  std::array<Eigen::VectorXd, model::num_constraints> order_parameter;
};

/// The linear equations M_k p = b of the maximiser p.
struct MomentEquations {
  fem::MassMatrix mass;  ///< int phi_i phi_j / k_kappa, shape (N, N)
  mesh::Positions rhs;   ///< dE_h/dp at p = 0, shape (N, 3)
};

/// One discrete energy of the membrane, the dual mixed form with the bending moment p as third
/// field:
///
///   E_h(x, p, c) = int grad x : grad p + kappa_s(c) nu . p - |p|^2 / (2 k_kappa(c))
///                + int sigma (eps/2 |grad c|^2 + psi(c) / eps)  +  sum_i k_g(c_i) G_i(x)
///
/// E_h(x, c) is its maximum over p, so its derivative is the partial one at the maximiser. G_i =
/// int phi_i dK is the distributional Gauss curvature: curvature inside the elements, geodesic
/// curvature of their edges and angles at their corners; sum_i G_i = 2 pi chi is used exactly. All
/// terms are sums over elements. Methods throw RecoverableError when an element is degenerate.
class EnergyProblem {
 public:
  /// Makes the problem on a mesh. `threads` is the number of threads of parallel_for; 0 takes all
  /// cores.
  EnergyProblem(std::shared_ptr<const mesh::Triangulation> triangulation, model::Model model,
                int threads);

  [[nodiscard]] const model::Model& model() const { return model_; }
  [[nodiscard]] const mesh::Triangulation& triangulation() const { return *triangulation_; }
  [[nodiscard]] const fem::NodeGraph& graph() const { return graph_; }

  /// Computes the equations of the maximiser p; the moment of `fields` has no effect.
  [[nodiscard]] MomentEquations moment_equations(const EnergyFields& fields) const;
  /// Computes the maximiser p, shape (N, 3), with one solve with the mass matrix weighted by
  /// 1/k_kappa.
  [[nodiscard]] mesh::Positions moment(const mesh::Positions& positions,
                                       const Eigen::VectorXd& order_parameter,
                                       double time = 0) const;
  /// Returns the fields with p at the maximum of the energy.
  [[nodiscard]] EnergyFields fields(const mesh::Positions& positions,
                                    const Eigen::VectorXd& order_parameter, double time = 0) const;
  /// Computes the parts of the energy E_h [energy].
  [[nodiscard]] model::EnergyParts energy(const EnergyFields& fields) const;
  /// Computes kappa = kappa_s - p . nu / k_kappa at the nodes, shape (N) [1/length].
  [[nodiscard]] Eigen::VectorXd mean_curvature(const EnergyFields& fields) const;
  /// Computes the derivative of E_h + sum lambda_i C_i with respect to the nodal values of x, p and
  /// c. With rates also the two terms of the gradient flow: int (x'.nu) nu . xi and eps omega int
  /// c' phi.
  [[nodiscard]] EnergyFields gradient(const EnergyFields& fields, const Multipliers& multipliers,
                                      const EnergyRates& rates = {}) const;
  /// Computes the derivative of dE_h/dp, shape (N, 3), along a change of positions and c at fixed
  /// p; empty fields do not change.
  [[nodiscard]] mesh::Positions moment_change(const EnergyFields& fields,
                                              const EnergyFields& change) const;
  /// Computes the derivative of `gradient` with respect to positions and c along a change of all
  /// fields and rates: the product of the second derivative with it, without a matrix. The moment
  /// of the result is empty.
  [[nodiscard]] EnergyFields gradient_change(const EnergyFields& fields,
                                             const Multipliers& multipliers,
                                             const EnergyRates& rates, const EnergyFields& change,
                                             const EnergyRates& rate_change) const;
  /// Computes the derivative of `gradient` for moves of the nodes along `directions`, shape (N, 3):
  /// block (node, node) of a matrix from `graph().block_pattern(4 or 5)`, unknowns of a node in the
  /// order p, displacement, c. Symmetric for weights {1, 0}. Unknowns p always count with weight 1.
  void hessian(const EnergyFields& fields, const Multipliers& multipliers, const EnergyRates& rates,
               const mesh::Positions& directions, const JacobianWeights& weights,
               linalg::SparseMatrix& matrix) const;
  /// Computes the values and exact gradients of the constrained functionals.
  [[nodiscard]] ConstraintEvaluation constraints(const mesh::Positions& positions,
                                                 const Eigen::VectorXd& order_parameter) const;
  /// Computes the time derivatives of the values and gradients of `constraints` along the rates.
  [[nodiscard]] ConstraintEvaluation constraint_rates(const mesh::Positions& positions,
                                                      const Eigen::VectorXd& order_parameter,
                                                      const EnergyRates& rates) const;

 private:
  template <class T, class Change>
  [[nodiscard]] Eigen::MatrixXd assemble_gradient(const EnergyFields& fields,
                                                  const Multipliers& multipliers,
                                                  const EnergyRates& rates,
                                                  const Change* along) const;
  template <class T>
  [[nodiscard]] ConstraintEvaluation assemble_constraints(const EnergyFields& fields,
                                                          const EnergyRates& rates) const;
  template <int Block>
  void assemble_hessian(const EnergyFields& fields, const Multipliers& multipliers,
                        const EnergyRates& rates, const mesh::Positions& directions,
                        const JacobianWeights& weights, linalg::SparseMatrix& matrix) const;

  std::shared_ptr<const mesh::Triangulation> triangulation_;
  model::Model model_;
  fem::NodeGraph graph_;
  Eigen::VectorXd vertex_angles_;  // 2 pi over the number of elements at a vertex, 0 at mid-edges
  int threads_;
};

}  // namespace vesica::problem
