#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "vesica/core/fields.hpp"
#include "vesica/linalg/sparse_matrix.hpp"

namespace vesica::linalg {

/// Library that factorises the sparse matrices. MUMPS keeps factors in single precision.
enum class DirectSolverKind { umfpack, klu, mumps };

#ifdef VESICA_WITHOUT_UMFPACK
inline constexpr DirectSolverKind default_direct_solver = DirectSolverKind::klu;
#else
inline constexpr DirectSolverKind default_direct_solver = DirectSolverKind::umfpack;
#endif
/// The library whose factors are the fastest preconditioner.
#ifdef VESICA_WITHOUT_MUMPS
inline constexpr DirectSolverKind default_preconditioner = default_direct_solver;
#else
inline constexpr DirectSolverKind default_preconditioner = DirectSolverKind::mumps;
#endif

/// Sparse LU factorisation. The pattern is analysed once, at construction; one of the five abstract
/// classes of the library.
class DirectSolver {
 public:
  DirectSolver() = default;
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;
  virtual ~DirectSolver() = default;

  /// Computes the factors of a matrix with the pattern given at construction. Throws
  /// RecoverableError when the matrix is singular or holds a NaN, SolverError when the library
  /// refuses.
  virtual void factorise(const SparseMatrix& matrix) = 0;
  /// Solves A x = b to round-off with the last factors; `b` and `x` may not overlap.
  virtual void solve(std::span<const double> b, std::span<double> x) const = 0;
  /// Solves A x = b to some five digits at least, for a preconditioner; exact where factors are.
  virtual void precondition(std::span<const double> b, std::span<double> x) const { solve(b, x); }
};

/// Makes a solver for the pattern of `matrix`, whose unknowns come in groups of `block_size` that
/// share a node: the fill-reducing ordering (METIS nested dissection) is taken on the graph of the
/// nodes. Throws ConfigError for a solver that this build leaves out.
[[nodiscard]] std::unique_ptr<DirectSolver> make_direct_solver(DirectSolverKind kind,
                                                               const SparseMatrix& matrix,
                                                               int block_size);

}  // namespace vesica::linalg

namespace vesica {
template <>
struct EnumNames<linalg::DirectSolverKind> {
  static constexpr std::array<std::pair<linalg::DirectSolverKind, std::string_view>, 3> names{
      {{linalg::DirectSolverKind::umfpack, "umfpack"},
       {linalg::DirectSolverKind::klu, "klu"},
       {linalg::DirectSolverKind::mumps, "mumps"}}};
};
}  // namespace vesica
