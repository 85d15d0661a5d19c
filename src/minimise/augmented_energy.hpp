#pragma once

#include <Eigen/Core>

#include "energy_sample.hpp"
#include "minimiser_coordinates.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::minimise {

/// Surface and phase field as a point of a normal graph, with energy, constraints and their
/// derivatives there.
struct GraphPoint {
  Eigen::VectorXd unknowns;  ///< u = (d, c)
  EnergySample sample;
};

/// Problem of one inner minimisation, the same in all its iterations.
struct InnerProblem {
  const problem::EnergyProblem& energy;
  const problem::NormalGraph& graph;
  const ConstraintSet& constraints;
  const MinimiserCoordinates& coordinates;
  Eigen::VectorXd multipliers;
  Eigen::VectorXd weights;  ///< rho of each constraint
  double largest_move = 0;  ///< points with a larger max|d| are refused [length]
  double energy_unit = 1;   ///< of the values [energy]
};

/// The augmented Lagrangian E + sum lambda_i C_i + rho_i C_i^2 / 2 (C_i measured from the target)
/// in the variables y, y = 0 at `start`, in the energy unit of the problem. The bending moment is
/// at its maximum in each evaluation.
class AugmentedEnergy {
 public:
  /// Makes the function. It keeps references to both arguments.
  AugmentedEnergy(const InnerProblem& problem, const GraphPoint& start);

  /// Computes the value at y and, unless null, the gradient. Returns false for a point that is
  /// refused because it is degenerate or too far away.
  bool evaluate(const Eigen::VectorXd& y, double& value, double* gradient);

  /// Returns the last point that was not refused; last_variables() is its y.
  [[nodiscard]] const GraphPoint& last() const { return last_; }
  [[nodiscard]] const Eigen::VectorXd& last_variables() const { return last_variables_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long refusals() const { return refusals_; }
  /// Returns the seconds of evaluations (residual) and of solves with the factors of the metric
  /// (solve).
  [[nodiscard]] const solve::SolverSeconds& seconds() const { return seconds_; }
  [[nodiscard]] double value(const EnergySample& sample) const;

 private:
  [[nodiscard]] Eigen::VectorXd gradient(const EnergySample& sample) const;
  bool visit(const Eigen::VectorXd& y);

  const InnerProblem& problem_;
  const GraphPoint& start_;
  GraphPoint last_;
  Eigen::VectorXd last_variables_;
  long evaluations_ = 0;
  long refusals_ = 0;
  solve::SolverSeconds seconds_;
};

}  // namespace vesica::minimise
