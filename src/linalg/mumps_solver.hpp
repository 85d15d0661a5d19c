#pragma once

#include <memory>

#include "vesica/linalg/direct_solver.hpp"

namespace vesica::linalg {

/// Makes a solver that keeps the factors of MUMPS in single precision: half the memory and half the
/// time or less. `solve` refines its answer in double precision. Throws as make_direct_solver.
[[nodiscard]] std::unique_ptr<DirectSolver> make_mumps_solver(const SparseMatrix& matrix,
                                                              int block_size);

}  // namespace vesica::linalg
