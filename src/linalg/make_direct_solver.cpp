#include "klu_solver.hpp"
#include "vesica/core/error.hpp"
#include "vesica/linalg/direct_solver.hpp"
#ifndef VESICA_WITHOUT_UMFPACK
#include "umfpack_solver.hpp"
#endif

namespace vesica::linalg {

std::unique_ptr<DirectSolver> make_direct_solver(DirectSolverKind kind, const SparseMatrix& matrix,
                                                 int block_size) {
  if (kind == DirectSolverKind::klu) return make_klu_solver(matrix, block_size);
#ifdef VESICA_WITHOUT_UMFPACK
  throw ConfigError(
      "solver.linear_solver = umfpack: this build has klu alone (VESICA_WITH_UMFPACK=OFF)");
#else
  return make_umfpack_solver(matrix);
#endif
}

}  // namespace vesica::linalg
