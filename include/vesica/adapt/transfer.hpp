#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::adapt {

// Nodal fields of the old mesh are carried over by mesh::interpolate(old triangulation, origins,
// field) with the origins of local_remesh or mesh::redistribute. Integrals that a run holds fixed
// are then off by the interpolation error; restore_integrals puts them back.

/// Fields that the integrals depend on.
struct RestorableFields {
  mesh::Positions positions;        ///< x, shape (N, 3)
  Eigen::VectorXd order_parameter;  ///< c, shape (N), or (0) for a single-phase vesicle
};

/// Function that returns the integrals to be restored, such as V, A, int h(c); any number, always
/// the same.
using Integrals = std::function<Eigen::VectorXd(const RestorableFields& fields)>;

/// Result of restore_integrals: the fields, and how well they meet the targets.
struct Restored {
  RestorableFields fields;
  Eigen::VectorXd error;  ///< integrals - targets
  int num_steps = 0;      ///< of Newton's method
  bool converged = false;
};

/// A change at the nodes: of the positions along the normals, and of the order parameter; each of
/// shape (N), or (0) for none.
struct NodalChange {
  Eigen::VectorXd normal;
  Eigen::VectorXd order_parameter;
};

/// Makes directions of changes: for V, A and int h(c) the variations 1, -kappa and h'(c) do. The
/// normal at a node is the mean of the normals of its triangles. The directions are smooth fields,
/// so the mesh stays as it is and no noise comes in.
[[nodiscard]] std::vector<RestorableFields> restoring_directions(
    const mesh::Surface& surface, const std::vector<NodalChange>& changes);

/// Restores integrals by Newton's method for the coefficients s of fields = start + sum_k s_k
/// directions_k at which the integrals have their targets, with central differences for the
/// derivatives along the directions. Where the directions do not suffice (nu and kappa nu on a
/// sphere), the smallest change with the smallest error; then, or after 8 steps, `converged` is
/// false. Empty fields of a direction are zero. Throws ConfigError when the integrals and the
/// targets differ in number.
[[nodiscard]] Restored restore_integrals(const Integrals& integrals, const Eigen::VectorXd& targets,
                                         const std::vector<RestorableFields>& directions,
                                         const RestorableFields& start);

}  // namespace vesica::adapt
