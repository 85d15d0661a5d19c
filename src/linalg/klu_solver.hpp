#pragma once

#include <memory>

#include "vesica/linalg/direct_solver.hpp"

namespace vesica::linalg {

[[nodiscard]] std::unique_ptr<DirectSolver> make_klu_solver(const SparseMatrix& matrix,
                                                            int block_size);

}  // namespace vesica::linalg
