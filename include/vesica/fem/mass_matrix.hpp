#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "vesica/fem/node_graph.hpp"

namespace vesica::fem {

/// Mass matrix of the quadratic elements on a surface, shape (N, N), on the pairs of a NodeGraph.
using MassMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// Gathers the 6 x 6 element matrices of all triangles, shape (T, 36), into the mass matrix.
[[nodiscard]] MassMatrix gather_mass_matrix(const NodeGraph& graph,
                                            const std::vector<double>& element_matrices,
                                            int threads);

/// Three values for each node, shape (N, 3).
using NodalTriple = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Solves M x = b for the three columns of `rhs` at once by conjugate gradients with the diagonal
/// as preconditioner (condition number about 5, so some 25 iterations for a relative residual of
/// 1e-11), from `guess`, shape (N, 3) or empty: zero. The residual, in the norm of the
/// preconditioner, falls below `tolerance` times the largest column of `rhs`. Throws
/// RecoverableError when they do not converge: the surface is degenerate.
[[nodiscard]] NodalTriple solve_mass_matrix(const MassMatrix& mass, const NodalTriple& rhs,
                                            int threads, const NodalTriple& guess = {},
                                            double tolerance = 1e-11);

}  // namespace vesica::fem
