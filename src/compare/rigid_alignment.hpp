#pragma once

#include <vector>

#include "measure/surface_probe.hpp"
#include "vesica/compare/shape_distance.hpp"

namespace vesica::compare {

/// Points of the first and of the second surface at which a misfit is measured.
struct ProbeSets {
  std::vector<measure::Probe> first;
  std::vector<measure::Probe> second;
};

/// What separates two surfaces: means over the probes of both, as squares.
struct Misfit {
  double shape = 0;  ///< d^2 / R_c^2
  double phase = 0;  ///< (c_1 - c_2)^2
};

/// Moves one surface onto another.
class RigidAlignment {
 public:
  /// Both must outlive this object.
  RigidAlignment(const measure::SurfaceProbe& first, const measure::SurfaceProbe& second);

  /// R_c = sqrt((A_1 + A_2) / 8 pi).
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] Misfit misfit(const ProbeSets& probes, const RigidMotion& motion) const;

  /// Makes shape + phase_weight * phase smaller, starting from `motion`: the method of Levenberg
  /// and Marquardt on the distances, with their slopes along the lines to the closest points. Ends
  /// when a step changes the misfit by less than 1e-26, or 1e-10 of the misfit at the start.
  [[nodiscard]] RigidMotion refined(const ProbeSets& probes, const RigidMotion& motion,
                                    double phase_weight, int most_steps) const;

 private:
  struct Residuals;

  const measure::SurfaceProbe& first_;
  const measure::SurfaceProbe& second_;
  double length_;
};

}  // namespace vesica::compare
