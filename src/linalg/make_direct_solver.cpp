#include <fmt/format.h>

#include "klu_solver.hpp"
#include "vesica/core/error.hpp"
#include "vesica/linalg/direct_solver.hpp"
#ifndef VESICA_WITHOUT_UMFPACK
#include "umfpack_solver.hpp"
#endif
#ifndef VESICA_WITHOUT_MUMPS
#include "mumps_solver.hpp"
#endif

namespace vesica::linalg {

std::unique_ptr<DirectSolver> make_direct_solver(DirectSolverKind kind, const SparseMatrix& matrix,
                                                 int block_size) {
  switch (kind) {
    case DirectSolverKind::klu:
      return make_klu_solver(matrix, block_size);
    case DirectSolverKind::umfpack:
#ifndef VESICA_WITHOUT_UMFPACK
      return make_umfpack_solver(matrix);
#else
      break;
#endif
    case DirectSolverKind::mumps:
#ifndef VESICA_WITHOUT_MUMPS
      return make_mumps_solver(matrix, block_size);
#else
      break;
#endif
  }
  throw ConfigError(
      fmt::format("solver.linear_solver = {}: this build leaves it out (VESICA_WITH_UMFPACK, "
                  "VESICA_WITH_MUMPS)",
                  name_of(kind)));
}

}  // namespace vesica::linalg
