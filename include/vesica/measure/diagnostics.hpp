#pragma once

#include <optional>
#include <vector>

#include "vesica/measure/phase_domains.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// L2 norms of the velocity over the surface [length^2/time].
struct VelocityNorms {
  double normal = 0;             ///< ||v . nu||
  double normal_rigid_free = 0;  ///< the same after the best-fit rigid motion is taken away
  double tangential = 0;         ///< ||v - (v . nu) nu||
};

/// What is measured after every accepted step.
struct Diagnostics {
  model::EnergyParts energy;
  model::Measures measures;  ///< the constrained functionals
  model::PerConstraint
      constraint_errors;  ///< relative: (C - target) / scale, scale = |target| (area for the phase)
  VelocityNorms velocity;
  double quality = 0;  ///< (3.5): smallest sine of the angles of the four flat sub-triangles
  std::vector<PhaseDomain> domains;  ///< as phase_domains()
};

/// Dimensionless numbers of Section 4 and lengths of the shape; what is not defined for it is
/// absent.
struct ShapeNumbers {
  double characteristic_radius = 0;               ///< R_c = sqrt(A / 4 pi) (4.2) [length]
  double reduced_volume = 0;                      ///< v_r
  std::optional<double> phase_fraction;           ///< x_r = A_2 / A
  std::optional<double> reduced_line_tension;     ///< R_c (4/3 sigma) / k^(1)
  std::optional<double> rigidity_ratio;           ///< b_r = k^(2) / k^(1)
  std::optional<double> saddle_splay_difference;  ///< Delta_g = (k_g^(1) - k_g^(2)) / k^(1)
  std::optional<double> neck_radius;  ///< smallest interior minimum of (cross-section perimeter)/2
                                      ///< pi along the long axis
  std::optional<double> length;       ///< extent along the long axis
  std::optional<int> domains_1;       ///< connected domains with c > 0
  std::optional<int> domains_2;       ///< connected domains with c < 0
};

/// Fields at the nodes for pictures, shape (N) or (N, 3).
struct NodalFields {
  Eigen::VectorXd normal_velocity;  ///< v . nu [length/time]
  Eigen::VectorXd
      bending_energy_density;  ///< k_kappa(c)/2 (kappa - kappa_s(c))^2 [energy/length^2]
  mesh::Positions
      normals;  ///< unit outward normals, area-weighted mean of the elements around a node
};

/// With the material and the targets at `state.time`.
[[nodiscard]] Diagnostics measure(const model::Model& model, const problem::State& state);
[[nodiscard]] ShapeNumbers shape_numbers(const model::Model& model, const problem::State& state);
[[nodiscard]] NodalFields nodal_fields(const model::Model& model, const problem::State& state);

}  // namespace vesica::measure
