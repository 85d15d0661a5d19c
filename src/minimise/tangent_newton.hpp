#pragma once

#include <Eigen/Core>

#include "minimiser_coordinates.hpp"
#include "reduced_hessian.hpp"
#include "solve/lowest_eigenvalue.hpp"

namespace vesica::minimise {

/// Newton step in z.
struct NewtonStep {
  Eigen::VectorXd change;
  bool meets_saddle = false;  ///< the energy curves downwards along a direction that was met
  int products = 0;           ///< with the second derivative
};

/// The second derivative of the Lagrangian in the variables z of the minimiser, on the tangent
/// space of the constraints. The metric is made for it: most of its eigenvalues are near 1,
/// whatever the mesh.
class TangentHessian {
 public:
  /// Makes the operator. It keeps references to its arguments.
  TangentHessian(const ReducedHessian& hessian, const MinimiserCoordinates& coordinates,
                 const Slopes& slopes);

  /// Returns the Newton step for the optimality system: the shortest change that takes the
  /// constraints by -errors, to first order, and along them conjugate gradients until the residual
  /// is below `reduction` of its start. Where the energy curves downwards they stop, or with
  /// `passes_saddles` go on towards the equilibrium.
  [[nodiscard]] NewtonStep step(const Eigen::VectorXd& multipliers, const Eigen::VectorXd& errors,
                                double reduction, bool passes_saddles) const;
  /// Returns the lowest eigenvalue, a pure number, negative at a saddle.
  [[nodiscard]] solve::Eigenpair lowest() const;

 private:
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::VectorXd along_constraints(Eigen::VectorXd z) const;

  const ReducedHessian& hessian_;
  const MinimiserCoordinates& coordinates_;
  const Slopes& slopes_;
  Eigen::MatrixXd constrained_;  // orthonormal basis of the directions that change constraints
};

}  // namespace vesica::minimise
