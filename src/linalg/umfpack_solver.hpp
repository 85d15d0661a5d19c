#pragma once

#include <memory>

#include "vesica/linalg/direct_solver.hpp"

namespace vesica::linalg {

[[nodiscard]] std::unique_ptr<DirectSolver> make_umfpack_solver(const SparseMatrix& matrix);

}  // namespace vesica::linalg
