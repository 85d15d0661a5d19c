#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::problem {

/// One value for each constraint; a constraint that is left free has none.
/// Multipliers: volume [energy/length^3], area and phase [energy/length^2], signs as in (1.7a):
/// dF/dV = -volume.
struct PerConstraint {
  std::optional<double> volume;
  std::optional<double> area;
  std::optional<double> phase;

  /// The same in the order of model::Constraints, and back.
  [[nodiscard]] std::array<std::optional<double>, 3> in_order() const {
    return {volume, area, phase};
  }
  [[nodiscard]] static PerConstraint from(const std::array<std::optional<double>, 3>& values) {
    return {values[0], values[1], values[2]};
  }
};

/// Nodal fields and multipliers, or their time derivatives.
struct Fields {
  mesh::Positions positions;  ///< x, shape (N, 3) [length]
  Eigen::VectorXd
      mean_curvature;  ///< kappa = kappa_1 + kappa_2, -2/R on a sphere, shape (N) [1/length]
  Eigen::VectorXd
      order_parameter;  ///< c, +1 in phase 1, shape (N), or (0) for a single-phase vesicle [-]
  PerConstraint multipliers;
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
