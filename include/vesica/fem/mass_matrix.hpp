#pragma once

#include <Eigen/Core>
#include <vector>

#include "vesica/fem/node_graph.hpp"

namespace vesica::fem {

/// Mass matrix of the quadratic elements on a surface, on the pairs of a NodeGraph.
struct MassMatrix {
  const NodeGraph& graph;
  std::vector<double> values;  ///< one a pair
  std::vector<double> inverse_diagonal;
};

/// Gathers 6 x 6 element matrices, shape (T, 36).
[[nodiscard]] MassMatrix gather_mass_matrix(const NodeGraph& graph,
                                            const std::vector<double>& element_matrices,
                                            int threads);

/// Three values a node, shape (N, 3).
using NodalTriple = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Solves M x = b for the three columns of `rhs` by conjugate gradients with the diagonal as
/// preconditioner (condition number about 5, so some 25 iterations for a relative residual of
/// 1e-11). Throws RecoverableError when it breaks down: the surface is degenerate.
[[nodiscard]] NodalTriple solve_mass_matrix(const MassMatrix& mass, const NodalTriple& rhs);

}  // namespace vesica::fem
