#pragma once

#include <Eigen/Core>
#include <functional>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Point (x, rho) of the curve that a surface of revolution is made of, for a parameter in [0, 1]
/// that runs from the left pole to the right one; rho = 0 at both ends, symmetric about 1/2.
using Profile = std::function<Eigen::Vector2d(double)>;

/// How a row of glued cubes is laid onto a surface of revolution around the x axis.
struct RevolutionOptions {
  int num_cubes;     ///< n cubes in a row along x
  int num_squares;   ///< m: each outer cube face has m x m squares, cut by one diagonal each
  double cap_angle;  ///< half opening angle [rad] of the end faces on a unit sphere, (0, pi/2)
};

/// Surface with 4 (4 n + 2) m^2 + 2 nodes, all of them on the profile's surface. Every parameter is
/// mirror symmetric when m is even. The end faces are equiangular squares around the poles; along
/// the cubes the rows are equidistant in the profile's parameter.
[[nodiscard]] mesh::Surface revolution_surface(const RevolutionOptions& options,
                                               const Profile& profile);

}  // namespace vesica::shapes
