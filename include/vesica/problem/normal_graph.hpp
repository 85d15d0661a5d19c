#pragma once

#include <Eigen/Core>

#include "vesica/mesh/triangulation.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Surface as a graph over a reference surface: x_i = X_i + d_i n_i. Nodes move along the normals
/// of the reference only; free positions would let every minimiser exploit the tangential motion of
/// the mesh.
struct NormalGraph {
  mesh::Positions reference;   ///< X, shape (N, 3) [length]
  mesh::Positions directions;  ///< n, unit normals at the nodes of the reference, shape (N, 3)
  /// Rigid gauge, shape (N, 6): sum_i gauge(i, k) d_i = 0. Columns int phi_i r_k . nu of the rigid
  /// velocities r_k on the reference, orthonormal in L2; a motion that does not move the shape (the
  /// rotation about the axis of a body of revolution) has a zero column.
  Eigen::Matrix<double, Eigen::Dynamic, 6> gauge;

  /// Returns the positions x = X + d n of the nodes, shape (N, 3), for displacements d, shape (N)
  /// [length].
  [[nodiscard]] mesh::Positions positions(const Eigen::VectorXd& displacements) const;
  /// Returns the smallest cosine between the direction of a node and the normal of the surface
  /// there; below about 0.85 the surface needs a new reference.
  [[nodiscard]] double smallest_cosine(const mesh::Triangulation& triangulation,
                                       const Eigen::VectorXd& displacements) const;
};

/// Makes the graph with displacement 0 over `positions`.
[[nodiscard]] NormalGraph make_normal_graph(const mesh::Triangulation& triangulation,
                                            const mesh::Positions& positions);

/// Computes the unit outward normals at the nodes, shape (N, 3): the mean of the elements around a
/// node, weighted with int phi_i^2.
[[nodiscard]] mesh::Positions nodal_normals(const mesh::Triangulation& triangulation,
                                            const mesh::Positions& positions);

}  // namespace vesica::problem
