#pragma once

#include <Eigen/Core>

#include "vesica/fem/node_graph.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::fem {

/// Shape operator at the nodes, shape (N, 6), components xx, yy, zz, xy, yz, xz, row-major
/// [1/length].
using NodalShapeOperator = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Recovers the symmetric part of the L2-projected shape operator Q_h of Section 3.1: with
/// M kappa_hat = A x,
///
///     int Q_h : Z = int -(div Z) . nu + nu (x) kappa_hat : Z    for all Z in S_h^(3x3)
///
/// (kappa_hat = -kappa nu; the sign in 3.1 of the paper is inconsistent, 3.3 is right). It is
/// +1/R P on a sphere. Conjugate gradients solve the systems with the mass matrix to a relative
/// residual of 1e-11. Throws RecoverableError when they do not converge.
[[nodiscard]] NodalShapeOperator recover_shape_operator(const mesh::Triangulation& triangulation,
                                                        const NodeGraph& graph,
                                                        const mesh::Positions& positions,
                                                        int threads);

/// Computes |Q| = sqrt(Q : Q) at one node, sqrt(2)/R on a sphere [1/length].
[[nodiscard]] double norm(const NodalShapeOperator& shape_operator, Eigen::Index node);

}  // namespace vesica::fem
