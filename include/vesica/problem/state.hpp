#pragma once

#include <Eigen/Core>
#include <memory>

#include "vesica/mesh/triangulation.hpp"
#include "vesica/model/per_term.hpp"

namespace vesica::problem {

/// Nodal fields and multipliers, or their time derivatives.
struct Fields {
  mesh::Positions positions;  ///< x, shape (N, 3) [length]
  /// kappa = kappa_1 + kappa_2, -2/R on a sphere, shape (N) [1/length].
  Eigen::VectorXd mean_curvature;
  /// c, +1 in phase 1, shape (N), or (0) for a single-phase vesicle [-].
  Eigen::VectorXd order_parameter;
  model::PerConstraint multipliers;
};

/// State of a vesicle at one time. A stepper owns it, everyone else borrows it const.
struct State {
  double time = 0;
  std::shared_ptr<const mesh::Triangulation> triangulation;
  Fields values;
  Fields rates;        ///< d/dt of `values` along the moving nodes; zero before the first step
  double damping = 0;  ///< tangential damping alpha of equation (b) [length^2/energy]

  [[nodiscard]] mesh::Surface surface() const { return {triangulation, values.positions}; }
  [[nodiscard]] bool is_two_phase() const { return values.order_parameter.size() > 0; }
};

}  // namespace vesica::problem
