#pragma once

#include <Eigen/Core>

#include "vesica/fem/surface_integral.hpp"

namespace vesica::problem {

using RigidModes = Eigen::Matrix<double, 6, 1>;
using RigidGram = Eigen::Matrix<double, 6, 6>;

/// Returns nu and x cross nu, the normal velocities of the translations and rotations about
/// `centre`.
inline RigidModes rigid_modes(const Vec3<double>& x, const Vec3<double>& centre,
                              const Vec3<double>& normal) {
  const auto moment = cross(x - centre, normal);
  RigidModes modes;
  modes << normal.x, normal.y, normal.z, moment.x, moment.y, moment.z;
  return modes;
}

/// Returns the centre of mass of the surface.
inline Vec3<double> centroid(const mesh::Triangulation& triangulation,
                             const mesh::Positions& positions) {
  Vec3<double> sum;
  double area = 0;
  fem::for_each_point(triangulation, positions, [&](const fem::SurfaceSample& sample) {
    sum = sum + sample.weight * fem::vector_at(positions, sample);
    area += sample.weight;
  });
  return (1 / area) * sum;
}

}  // namespace vesica::problem
