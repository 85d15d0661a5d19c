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

/// Values of the integrals to be restored, such as V, A, int h(c); any number, always the same.
using Integrals = std::function<Eigen::VectorXd(const RestorableFields& fields)>;

struct Restored {
  RestorableFields fields;
  Eigen::VectorXd error;  ///< integrals - targets
  int num_steps = 0;      ///< of Newton's method
  bool converged = false;
};

/// Directions in which V, A and int h(c) are restored: nu, kappa nu (both move nodes), and h'(c)
/// (changes c; left out when `phase_derivative` is empty). nu is the mean of the normals of the
/// triangles at a node. Smooth fields: the mesh stays as it is, and no noise comes in.
[[nodiscard]] std::vector<RestorableFields> restoring_directions(
    const mesh::Surface& surface, const Eigen::VectorXd& mean_curvature,
    const Eigen::VectorXd& phase_derivative);

/// Newton's method for the coefficients s of fields = start + sum_k s_k directions_k at which the
/// integrals have their targets, with central differences for the derivatives along the directions.
/// Where the directions do not suffice (nu and kappa nu on a sphere), the smallest change with the
/// smallest error; then, or after 8 steps, `converged` is false. Empty fields of a direction are
/// zero. Throws ConfigError when the integrals and the targets differ in number.
[[nodiscard]] Restored restore_integrals(const Integrals& integrals, const Eigen::VectorXd& targets,
                                         const std::vector<RestorableFields>& directions,
                                         const RestorableFields& start);

}  // namespace vesica::adapt
