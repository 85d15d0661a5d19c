#pragma once

#include <Eigen/Core>

#include "energy_metric.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::minimise {

/// Returns an orthonormal basis of what the columns span, shape (n, rank).
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

/// Derivatives of energy and constraints with respect to z, with the rigid motions taken out.
/// Constraints that depend on each other (volume and area of a sphere) share one direction.
struct Slopes {
  Eigen::VectorXd energy;
  Eigen::MatrixXd constraints;  ///< one column for each constraint

  /// Returns the lambda that makes |energy + constraints lambda| smallest.
  [[nodiscard]] Eigen::VectorXd multipliers() const;
  /// Returns the shortest change of z that changes the constraints by `errors`, to first order.
  [[nodiscard]] Eigen::VectorXd change_for(const Eigen::VectorXd& errors) const;
  /// Returns sqrt(g^T P g) of g = dE + sum lambda_i dC_i: about sqrt(2 (E - E_min)) [energy^(1/2)].
  [[nodiscard]] double distance(const Eigen::VectorXd& multipliers) const {
    return (energy + constraints * multipliers).norm();
  }
};

/// The variables y of the minimiser: a change of the unknowns is
///
///   P^(1/2) G T y,   G: takes the rigid motions out,
///                    T = step (1 + U ((1 + s^2)^(-1/2) - 1) U^T)
///
/// with U s V^T the singular values of G P^(T/2) C' rho^(1/2): the penalty rho/2 |C|^2 then has no
/// large curvature left.
class MinimiserCoordinates {
 public:
  /// Makes the coordinates. `metric` must outlive the coordinates and keep its factors.
  MinimiserCoordinates(const EnergyMetric& metric, const problem::NormalGraph& graph);

  /// Takes the large curvature of the penalty out of the variables. `weights`: rho of each
  /// constraint; `step`: length of a unit change of y.
  void absorb(const Eigen::MatrixXd& constraint_slopes, const Eigen::VectorXd& weights,
              double step);

  [[nodiscard]] Eigen::Index size() const { return metric_->size(); }
  [[nodiscard]] Eigen::VectorXd change(const Eigen::VectorXd& y) const;
  [[nodiscard]] Eigen::VectorXd pull_back(const Eigen::VectorXd& gradient) const;
  /// Returns G P^(T/2) g for a derivative g with respect to the unknowns.
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::VectorXd& gradient) const;
  /// Returns P^(1/2) z, a change of the unknowns.
  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& z) const {
    return metric_->spread(z);
  }
  /// Returns G z.
  [[nodiscard]] Eigen::VectorXd without_rigid(Eigen::VectorXd z) const;

 private:
  [[nodiscard]] Eigen::VectorXd rescale(Eigen::VectorXd y) const;

  const EnergyMetric* metric_;
  Eigen::MatrixXd rigid_;        // orthonormal columns
  Eigen::MatrixXd constrained_;  // U
  Eigen::VectorXd shrinkage_;    // (1 + s^2)^(-1/2) - 1
  double step_ = 1;
};

}  // namespace vesica::minimise
