#pragma once

#include <Eigen/Core>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// A connected part of the surface with c > 0 (phase 1) or c < 0 (phase 2).
struct PhaseDomain {
  int phase = 1;
  double area = 0;             ///< [length^2]
  double boundary_length = 0;  ///< of the curves c = 0 around it; 0 for the whole surface [length]
  /// Centroid int x / area, as a rule not on the surface [length].
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"phase", "-", "1 (c > 0) or 2 (c < 0)"}, self.phase);
    visit(Field{"area", "length^2", "area"}, self.area);
    visit(Field{"boundary_length", "length", "length of the curves c = 0"}, self.boundary_length);
    visit(Field{"centroid", "length", "int x / area"}, self.centroid);
  }
};

/// Returns all domains of both phases, those of phase 1 first, and within a phase the larger ones
/// first; none for a single-phase vesicle. Nodes with c of one sign belong together when they are
/// neighbours in a sub-triangle of an element; a single node makes a domain. The curve c = 0 is
/// followed in the quadratic c on the quadratic surface: area and length fall with the fourth power
/// of the mesh size or nearly.
[[nodiscard]] std::vector<PhaseDomain> phase_domains(const problem::State& state);

/// Counts the domains of a phase, 1 or 2.
[[nodiscard]] int num_domains(const std::vector<PhaseDomain>& domains, int phase);

}  // namespace vesica::measure
