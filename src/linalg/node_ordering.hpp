#pragma once

#include <vector>

#include "vesica/linalg/sparse_matrix.hpp"

namespace vesica::linalg {

/// Fill-reducing ordering (METIS nested dissection) of the graph whose vertices are groups of
/// `block_size` unknowns; position k of the result holds the unknown eliminated as number k. Throws
/// SolverError when METIS refuses.
[[nodiscard]] std::vector<SparseIndex> node_ordering(const SparseMatrix& matrix, int block_size);

}  // namespace vesica::linalg
