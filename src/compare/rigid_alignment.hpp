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

  /// Makes shape + phase_weight * phase smaller, starting from `motion`: Gauss-Newton on the
  /// distances along the normals (point to plane) with the exact gradient, in the norm of
  /// Levenberg and Marquardt. Motions that the misfit hardly feels (curvature below 1e-5 of the
  /// largest) are left alone. Ends when a step falls below 1e-13, or promises less than 1e-10 of
  /// the misfit.
  [[nodiscard]] RigidMotion refined(const ProbeSets& probes, RigidMotion motion,
                                    double phase_weight, int most_steps) const;

 private:
  struct Linearised;

  [[nodiscard]] Linearised linearised(const ProbeSets& probes, const RigidMotion& motion,
                                      double phase_weight) const;
  [[nodiscard]] RigidMotion moved(const RigidMotion& motion,
                                  const Eigen::Matrix<double, 6, 1>& step) const;

  const measure::SurfaceProbe& first_;
  const measure::SurfaceProbe& second_;
  double length_;
};

}  // namespace vesica::compare
