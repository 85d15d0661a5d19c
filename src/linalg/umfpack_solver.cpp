#include "umfpack_solver.hpp"

#include <fmt/format.h>
#include <umfpack.h>

#include <array>
#include <vector>

#include "blas_threads.hpp"
#include "metis_signals.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/handle.hpp"

namespace vesica::linalg {

namespace {

void free_symbolic(void* symbolic) { umfpack_dl_free_symbolic(&symbolic); }
void free_numeric(void* numeric) { umfpack_dl_free_numeric(&numeric); }
using SymbolicHandle = Handle<void*, free_symbolic>;
using NumericHandle = Handle<void*, free_numeric>;

std::string_view code_name(long code) {
  switch (code) {
    case UMFPACK_OK:
      return "UMFPACK_OK";
    case UMFPACK_WARNING_singular_matrix:
      return "UMFPACK_WARNING_singular_matrix";
    case UMFPACK_ERROR_out_of_memory:
      return "UMFPACK_ERROR_out_of_memory";
    case UMFPACK_ERROR_invalid_matrix:
      return "UMFPACK_ERROR_invalid_matrix";
    case UMFPACK_ERROR_different_pattern:
      return "UMFPACK_ERROR_different_pattern";
    case UMFPACK_ERROR_invalid_permutation:
      return "UMFPACK_ERROR_invalid_permutation";
    case UMFPACK_ERROR_ordering_failed:
      return "UMFPACK_ERROR_ordering_failed";
    default:
      return "UMFPACK error";
  }
}

void check(long code, std::string_view call) {
  if (code == UMFPACK_OK) return;
  const auto text = fmt::format("{}: {} ({})", call, code_name(code), code);
  if (code == UMFPACK_WARNING_singular_matrix) throw RecoverableError(text);
  throw SolverError(text);
}

class UmfpackSolver final : public DirectSolver {
 public:
  explicit UmfpackSolver(const SparseMatrix& matrix)
      : starts_(matrix.column_starts), rows_(matrix.rows) {
    umfpack_dl_defaults(control_.data());
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_IRSTEP] = 0;
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    void* symbolic = nullptr;
    const SignalsHeldFromMetis held;
    const auto code =
        umfpack_dl_symbolic(matrix.size, matrix.size, starts_.data(), rows_.data(),
                            matrix.values.data(), &symbolic, control_.data(), nullptr);
    symbolic_ = SymbolicHandle(symbolic);
    check(code, "umfpack_dl_symbolic");
  }

  void factorise(const SparseMatrix& matrix) override {
    numeric_ = NumericHandle();  // the old factors go first: two sets would double the memory
    const SingleThreadedBlas single_threaded;
    void* numeric = nullptr;
    const auto code = umfpack_dl_numeric(starts_.data(), rows_.data(), matrix.values.data(),
                                         symbolic_.get(), &numeric, control_.data(), nullptr);
    numeric_ = NumericHandle(numeric);
    check(code, "umfpack_dl_numeric");
  }

  void solve(std::span<const double> b, std::span<double> x) const override {
    const SingleThreadedBlas single_threaded;
    check(umfpack_dl_solve(UMFPACK_A, starts_.data(), rows_.data(), nullptr, x.data(), b.data(),
                           numeric_.get(), control_.data(), nullptr),
          "umfpack_dl_solve");
  }

 private:
  std::array<double, UMFPACK_CONTROL> control_{};
  std::vector<SparseIndex> starts_;
  std::vector<SparseIndex> rows_;
  SymbolicHandle symbolic_;
  NumericHandle numeric_;
};

}  // namespace

std::unique_ptr<DirectSolver> make_umfpack_solver(const SparseMatrix& matrix) {
  return std::make_unique<UmfpackSolver>(matrix);
}

}  // namespace vesica::linalg
