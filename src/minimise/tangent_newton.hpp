#pragma once

#include <Eigen/Core>
#include <optional>

#include "minimiser_coordinates.hpp"
#include "reduced_hessian.hpp"
#include "solve/lowest_eigenvalue.hpp"

namespace vesica::minimise {

/// Newton step in z, and what it promises.
struct NewtonStep {
  Eigen::VectorXd across;     ///< the shortest change that meets the constraints, to first order
  Eigen::VectorXd along;      ///< change on the tangent space of the constraints
  double across_change = 0;   ///< of the Lagrangian, by `across` alone
  double slope = 0;           ///< first derivative of the Lagrangian along `along`, after `across`
  double curvature = 0;       ///< second derivative along it
  bool meets_saddle = false;  ///< the energy curves downwards along a direction that was met
  bool is_bounded = false;    ///< `along` ends at the radius
  int products = 0;           ///< with the second derivative

  /// Returns the change of the Lagrangian that across + scale along promises.
  [[nodiscard]] double promise(double scale) const {
    return across_change + scale * (slope + scale * curvature / 2);
  }
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
  /// constraints by -errors, to first order, and along them truncated conjugate gradients
  /// (Steihaug) until the residual is below `reduction` of its start, to the end of a ball of the
  /// given radius, or where the energy curves downwards to that end. Without a radius they go on
  /// towards the equilibrium, of whatever kind.
  [[nodiscard]] NewtonStep step(const Eigen::VectorXd& multipliers, const Eigen::VectorXd& errors,
                                double reduction, std::optional<double> radius) const;
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
