#include "klu_solver.hpp"

#include <fmt/format.h>
#include <klu.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "node_ordering.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {

namespace {

std::string_view code_name(long code) {
  switch (code) {
    case KLU_OK:
      return "KLU_OK";
    case KLU_SINGULAR:
      return "KLU_SINGULAR";
    case KLU_OUT_OF_MEMORY:
      return "KLU_OUT_OF_MEMORY";
    case KLU_INVALID:
      return "KLU_INVALID";
    case KLU_TOO_LARGE:
      return "KLU_TOO_LARGE";
    default:
      return "KLU error";
  }
}

/// KLU's handles need the common block for their release, so one object owns all three.
class KluSolver final : public DirectSolver {
 public:
  KluSolver(const SparseMatrix& matrix, int block_size)
      : starts_(matrix.column_starts), rows_(matrix.rows) {
    klu_l_defaults(&common_);
    common_.btf = 0;
    auto order = node_ordering(matrix, block_size);
    symbolic_ = klu_l_analyze_given(matrix.size, starts_.data(), rows_.data(), order.data(),
                                    order.data(), &common_);
    if (symbolic_ == nullptr) fail("klu_l_analyze_given");
  }
  ~KluSolver() override {
    klu_l_free_numeric(&numeric_, &common_);
    klu_l_free_symbolic(&symbolic_, &common_);
  }

  void factorise(const SparseMatrix& matrix) override {
    values_ = matrix.values;
    if (!std::all_of(values_.begin(), values_.end(), [](double v) { return std::isfinite(v); }))
      throw RecoverableError("klu_l_factor: the matrix holds a value that is not finite");
    klu_l_free_numeric(&numeric_, &common_);
    numeric_ = klu_l_factor(starts_.data(), rows_.data(), values_.data(), symbolic_, &common_);
    if (numeric_ == nullptr || common_.status != KLU_OK) fail("klu_l_factor");
  }

  void solve(std::span<const double> b, std::span<double> x) const override {
    std::copy(b.begin(), b.end(), x.begin());
    klu_l_common common = common_;  // klu_l_solve writes its status there
    if (klu_l_solve(symbolic_, numeric_, static_cast<SparseIndex>(x.size()), 1, x.data(),
                    &common) == 0) {
      throw SolverError(
          fmt::format("klu_l_solve: {} ({})", code_name(common.status), common.status));
    }
  }

 private:
  [[noreturn]] void fail(std::string_view call) {
    const auto text = fmt::format("{}: {} ({})", call, code_name(common_.status), common_.status);
    if (common_.status == KLU_SINGULAR) throw RecoverableError(text);
    throw SolverError(text);
  }

  klu_l_common common_{};
  klu_l_symbolic* symbolic_ = nullptr;
  klu_l_numeric* numeric_ = nullptr;
  std::vector<SparseIndex> starts_;
  std::vector<SparseIndex> rows_;
  std::vector<double> values_;
};

}  // namespace

std::unique_ptr<DirectSolver> make_klu_solver(const SparseMatrix& matrix, int block_size) {
  return std::make_unique<KluSolver>(matrix, block_size);
}

}  // namespace vesica::linalg
