#pragma once

#include <optional>
#include <vector>

#include "vesica/measure/phase_domains.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// L2 norms of the velocity v of the nodes over the surface [length^2/time]. nu is the outward unit
/// normal.
struct VelocityNorms {
  double normal = 0;             ///< ||v . nu||
  double normal_rigid_free = 0;  ///< ||v . nu|| without the best-fit rigid motion
  double tangential = 0;         ///< ||v - (v . nu) nu||

  /// Returns the norm of the normal velocity of the best-fit rigid motion.
  [[nodiscard]] double drift() const;
  /// Returns the norms divided by `length`.
  [[nodiscard]] VelocityNorms over(double length) const {
    return {normal / length, normal_rigid_free / length, tangential / length};
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"normal_velocity", "length/time", "without the best-fit rigid motion"},
          self.normal_rigid_free);
    visit(Field{"normal_velocity_plain", "length/time", "nothing removed"}, self.normal);
    visit(Field{"drift", "length/time", "of the rigid motion alone"}, self.drift());
    visit(Field{"tangential_velocity", "length/time", "of the tangential part"}, self.tangential);
  }
};

/// Holds what is measured after every accepted step: energy, constrained functionals and their
/// errors, velocity, mesh quality and the domains of the phases.
struct Diagnostics {
  model::EnergyParts energy;
  model::Measures measures;  ///< the constrained functionals
  /// Relative errors (C - target) / scale; the scale is |target|, or the area for the phase.
  model::PerConstraint constraint_errors;
  VelocityNorms velocity;
  double quality = 0;                ///< mesh quality (3.5)
  std::vector<PhaseDomain> domains;  ///< those that phase_domains() finds

  /// Returns R_c = sqrt(A / 4 pi) (4.2) [length].
  [[nodiscard]] double characteristic_radius() const;

  /// Visits all measured values except the velocity, which results give divided by R_c.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"energy/total", "energy", "sum of the parts"}, self.energy.total());
    visit(Field{"energy", "energy", "parts of the energy"}, self.energy);
    visit(Field{"constraints", "-", "relative errors"}, self.constraint_errors);
    visit(Field{"shape", "", "the constrained functionals"}, self.measures);
    visit(Field{"mesh/quality", "-",
                "(3.5): smallest sine of the angles of the four flat "
                "sub-triangles"},
          self.quality);
    visit(Field{"domains", "-", "connected domains of the phases"}, self.domains);
  }
};

/// Dimensionless numbers of Section 4 of the paper, and lengths of the shape. A number is absent
/// where the vesicle does not have it, as the neck radius of a sphere.
struct ShapeNumbers {
  double characteristic_radius = 0;
  double reduced_volume = 0;
  std::optional<double> phase_fraction;
  std::optional<double> reduced_line_tension;
  std::optional<double> rigidity_ratio;
  std::optional<double> saddle_splay_difference;
  std::optional<double> neck_radius;
  std::optional<double> length;
  std::optional<int> domains_1;
  std::optional<int> domains_2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"shape/characteristic_radius", "length", "R_c = sqrt(A / 4 pi) (4.2)"},
          self.characteristic_radius);
    visit(Field{"shape/reduced_volume", "-", "v_r"}, self.reduced_volume);
    visit(Field{"shape/phase_fraction", "-", "x_r = A_2 / A"}, self.phase_fraction);
    visit(Field{"shape/reduced_line_tension", "-", "R_c (4/3 sigma) / k^(1)"},
          self.reduced_line_tension);
    visit(Field{"shape/rigidity_ratio", "-", "b_r = k^(2) / k^(1)"}, self.rigidity_ratio);
    visit(Field{"shape/saddle_splay_difference", "-", "Delta_g = (k_g^(1) - k_g^(2)) / k^(1)"},
          self.saddle_splay_difference);
    visit(
        Field{"shape/neck_radius", "length",
              "smallest interior minimum of (cross-section perimeter) / 2 pi along the long axis"},
        self.neck_radius);
    visit(Field{"shape/length", "length", "extent along the long axis"}, self.length);
    visit(Field{"domains/phase_1", "-", "connected domains with c > 0"}, self.domains_1);
    visit(Field{"domains/phase_2", "-", "connected domains with c < 0"}, self.domains_2);
  }
};

/// Fields at the nodes for pictures, arrays of shape (N) or (N, 3).
struct NodalFields {
  Eigen::VectorXd normal_velocity;  ///< v . nu [length/time]
  /// k_kappa(c)/2 (kappa - kappa_s(c))^2 [energy/length^2].
  Eigen::VectorXd bending_energy_density;
  /// Unit outward normals, area-weighted mean of the elements around a node.
  mesh::Positions normals;
};

/// Measures a state. The material and the targets of the constraints are those at `state.time`.
/// Throws RecoverableError when the shape operator of a degenerate surface cannot be recovered.
[[nodiscard]] Diagnostics measure(const model::Model& model, const problem::State& state);
/// Computes the dimensionless numbers and the lengths of a state, with the material at
/// `state.time`.
[[nodiscard]] ShapeNumbers shape_numbers(const model::Model& model, const problem::State& state);
/// Computes the fields for pictures at the nodes of a state, with the material at `state.time`.
[[nodiscard]] NodalFields nodal_fields(const model::Model& model, const problem::State& state);

}  // namespace vesica::measure
