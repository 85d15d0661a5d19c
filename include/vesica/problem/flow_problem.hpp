#pragma once

#include <Eigen/Core>
#include <optional>

#include "vesica/linalg/bordered_solver.hpp"
#include "vesica/model/model.hpp"
#include "vesica/model/per_term.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Form of equation (e): the exact derivative of the discrete functionals, d/dt C_i + gamma (C_i -
/// target_i) = target_i', or the constraints themselves, C_i = target_i.
enum class ConstraintForm { differentiated, original };

/// Parameters of the equations that are not unknowns.
struct EquationSettings {
  double damping = 1;            ///< alpha of (b) [length^2/energy]
  double constraint_rate = 100;  ///< gamma of (e) [1/time]
  ConstraintForm form = ConstraintForm::differentiated;
};

/// Weights of the Jacobian J = value * dF/dy + rate * dF/dy' for the unknowns with a time
/// derivative; algebraic unknowns, which have none, always enter with dF/dy. IDA's Jacobian is {1,
/// cj}; {0, 1} is the matrix for consistent initial values.
struct JacobianWeights {
  double value = 1;
  double rate = 0;
};

/// Unknowns of a FlowProblem and their time derivatives, both of shape (size()).
struct Unknowns {
  Eigen::VectorXd values;
  Eigen::VectorXd rates;
};

/// Semi-discrete equations F(t, y, y') = 0 of a relaxation flow on one mesh, as IDA integrates
/// them. y holds the unknowns of the nodes, block_size() a node, then the multipliers. Methods that
/// evaluate throw RecoverableError when an element is degenerate or a value is not finite.
class FlowProblem {
 public:
  FlowProblem() = default;
  FlowProblem(const FlowProblem&) = delete;
  FlowProblem& operator=(const FlowProblem&) = delete;
  virtual ~FlowProblem() = default;

  [[nodiscard]] virtual const model::Model& model() const = 0;
  [[nodiscard]] virtual int block_size() const = 0;
  [[nodiscard]] virtual Eigen::Index num_nodal() const = 0;
  [[nodiscard]] virtual Eigen::Index num_multipliers() const = 0;
  [[nodiscard]] Eigen::Index size() const { return num_nodal() + num_multipliers(); }

  /// Returns y with the positions and the order parameter of a start and first guesses of the
  /// algebraic unknowns.
  [[nodiscard]] virtual Eigen::VectorXd initial_values(const State& start) const = 0;
  /// Returns y and y' of a state as it is, where a run goes on from it.
  [[nodiscard]] virtual Unknowns unknowns(const State& state) const = 0;
  /// Returns the nodal fields and multipliers of y.
  [[nodiscard]] virtual Fields values(double time, const Eigen::VectorXd& y) const = 0;
  /// Returns the time derivatives of the nodal fields and multipliers from y and y'.
  [[nodiscard]] virtual Fields rates(const Eigen::VectorXd& y,
                                     const Eigen::VectorXd& y_rate) const = 0;
  /// Returns a vector of shape (size()) with 1 where an unknown has a time derivative in the
  /// equations, 0 for algebraic unknowns.
  [[nodiscard]] virtual Eigen::VectorXd differential_mask() const = 0;
  /// Returns the natural size of each unknown, shape (size()); errors are measured in it.
  [[nodiscard]] virtual Eigen::VectorXd units(const Scales& scales) const = 0;
  /// Computes the energy of the discretisation with the material at a time; absent for a
  /// discretisation without a discrete energy.
  [[nodiscard]] virtual std::optional<model::EnergyParts> energy(double,
                                                                 const Eigen::VectorXd&) const {
    return std::nullopt;
  }

  /// Computes the residual F(t, y, y'), shape (size()).
  [[nodiscard]] virtual Eigen::VectorXd residual(const EquationSettings& settings, double time,
                                                 const Eigen::VectorXd& y,
                                                 const Eigen::VectorXd& y_rate) const = 0;

  /// Renews coordinates that follow the surface: when it has moved far, the present surface becomes
  /// the new reference, (y, y') are rewritten and true is returned.
  virtual bool renew_coordinates(Eigen::VectorXd& y, Eigen::VectorXd& y_rate) {
    (void)y;
    (void)y_rate;
    return false;
  }
};

/// A FlowProblem whose Jacobian is a sparse matrix with a border; the unknowns of the nodes stand
/// node by node.
class AssembledProblem : public FlowProblem {
 public:
  /// Makes a bordered matrix with the pattern that `jacobian` fills.
  [[nodiscard]] virtual linalg::BorderedMatrix make_matrix() const = 0;
  /// Computes the Jacobian of `residual` at the same arguments, with these weights, into `matrix`,
  /// which make_matrix() made.
  virtual void jacobian(const EquationSettings& settings, const JacobianWeights& weights,
                        double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                        linalg::BorderedMatrix& matrix) const = 0;
};

}  // namespace vesica::problem
