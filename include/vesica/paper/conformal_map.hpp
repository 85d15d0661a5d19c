#pragma once

#include <Eigen/Core>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::paper {

/// A map of the flat triangles between the corners of a surface to the unit sphere, linear on each
/// of them.
struct ConformalMap {
  mesh::Positions images;  ///< u at the corners, |u| = 1; mid-edge nodes: middles of chords
  double energy = 0;       ///< 1/2 int |grad u|^2 >= the area of the image, near 4 pi
  double residual = 0;     ///< largest tangential force on a corner
  int num_steps = 0;       ///< of Newton's method
  bool converged = false;
  int num_flipped = 0;  ///< triangles whose image is turned over
};

/// Checks the genus. Throws ConfigError naming it when the surface is no deformed sphere (one
/// component, genus 0).
void check_genus_zero(const mesh::Triangulation& triangulation);

/// Computes the conformal map of a surface of genus 0, as the stationary point of (3.6),
///
///     F(u, rho) = 1/2 int |grad u|^2 + sum_i rho_i (|u_i|^2 - 1),
///
/// in linear elements. The conformal group of the sphere is fixed by six more conditions with
/// multipliers: sum_i a_i u_i = 0, a_i the area around corner i, and no rotation away from the
/// first guess. That guess is the limit of the conformalised mean curvature flow (M(x) d/dt x =
/// -A_0 x, A_0 the stiffness matrix of the surface), which finds the sphere from every start;
/// Newton's method on the saddle point does the rest. Throws ConfigError as check_genus_zero.
[[nodiscard]] ConformalMap conformal_map(const mesh::Surface& surface);

}  // namespace vesica::paper
