#include "supernodal_cholesky.hpp"

#ifdef VESICA_WITHOUT_UMFPACK
#include "vesica/linalg/sparse_cholesky.hpp"
#else
#include <cholmod.h>
#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "blas_threads.hpp"
#include "node_ordering.hpp"
#include "vesica/core/error.hpp"
#endif

namespace vesica::linalg {

#ifdef VESICA_WITHOUT_UMFPACK

struct SupernodalCholesky::Factors {
  SparseCholesky simplicial;
};

SupernodalCholesky::SupernodalCholesky(const SparseMatrix& pattern)
    : factors_(new Factors{SparseCholesky(pattern)}) {}

SupernodalCholesky::SupernodalCholesky(const SparseMatrix& pattern, const SupernodalCholesky&)
    : SupernodalCholesky(pattern) {}

void SupernodalCholesky::factorise(const SparseMatrix& matrix) {
  factors_->simplicial.factorise(matrix);
}

Eigen::MatrixXd SupernodalCholesky::solve(const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd x(b.rows(), b.cols());
  for (Eigen::Index k = 0; k < b.cols(); ++k) x.col(k) = factors_->simplicial.solve(b.col(k));
  return x;
}

#else

/// The lower triangle of the pattern, and what CHOLMOD makes of it. The workspace of the solves is
/// kept from one to the next.
struct SupernodalCholesky::Factors {
  cholmod_common common{};
  std::vector<std::int32_t> order;
  std::vector<std::int32_t> starts;
  std::vector<std::int32_t> rows;
  std::vector<double> values;
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;
  cholmod_dense* first_work = nullptr;
  cholmod_dense* second_work = nullptr;

  Factors() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&first_work, &common);
    cholmod_free_dense(&second_work, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  void check(bool is_done, std::string_view call) const {
    if (common.status == CHOLMOD_NOT_POSDEF)
      throw RecoverableError("Cholesky factorisation: the matrix is not positive definite");
    if (!is_done || common.status < CHOLMOD_OK)
      throw SolverError(fmt::format("{}: status {}", call, common.status));
  }

  void take_pattern(const SparseMatrix& pattern) {
    starts.push_back(0);
    for (SparseIndex column = 0; column < pattern.size; ++column) {
      const auto end = pattern.column_starts[static_cast<std::size_t>(column) + 1];
      for (auto k = pattern.column_starts[static_cast<std::size_t>(column)]; k < end; ++k) {
        const auto row = pattern.rows[static_cast<std::size_t>(k)];
        if (row >= column) rows.push_back(static_cast<std::int32_t>(row));
      }
      starts.push_back(static_cast<std::int32_t>(rows.size()));
    }
    values.resize(rows.size());
  }

  /// The diagonal is the first entry at or below itself.
  void take_values(const SparseMatrix& matrix) {
    for (std::size_t column = 0; column + 1 < starts.size(); ++column) {
      const auto count = static_cast<std::size_t>(starts[column + 1] - starts[column]);
      const auto end = static_cast<std::size_t>(matrix.column_starts[column + 1]);
      for (std::size_t k = 0; k < count; ++k)
        values[static_cast<std::size_t>(starts[column]) + k] = matrix.values[end - count + k];
    }
  }

  void analyse(const SparseMatrix& pattern) {
    take_pattern(pattern);
    auto matrix = view();
    factor = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &common);
    check(factor != nullptr, "cholmod_analyze_p");
  }

  cholmod_sparse view() {
    cholmod_sparse result{};
    result.nrow = result.ncol = starts.size() - 1;
    result.nzmax = rows.size();
    result.p = starts.data();
    result.i = rows.data();
    result.x = values.data();
    result.stype = -1;
    result.itype = CHOLMOD_INT;
    result.xtype = CHOLMOD_REAL;
    result.dtype = CHOLMOD_DOUBLE;
    result.sorted = 1;
    result.packed = 1;
    return result;
  }
};

SupernodalCholesky::SupernodalCholesky(const SparseMatrix& pattern)
    : factors_(std::make_unique<Factors>()) {
  const auto order = node_ordering(pattern, 1);
  factors_->order.assign(order.begin(), order.end());
  factors_->analyse(pattern);
}

SupernodalCholesky::SupernodalCholesky(const SparseMatrix& pattern,
                                       const SupernodalCholesky& ordered)
    : factors_(std::make_unique<Factors>()) {
  factors_->order = ordered.factors_->order;
  factors_->analyse(pattern);
}

void SupernodalCholesky::factorise(const SparseMatrix& matrix) {
  factors_->take_values(matrix);
  auto lower = factors_->view();
  const SingleThreadedBlas single_threaded;
  const int is_done = cholmod_factorize(&lower, factors_->factor, &factors_->common);
  factors_->check(is_done != 0, "cholmod_factorize");
}

Eigen::MatrixXd SupernodalCholesky::solve(const Eigen::MatrixXd& b) const {
  cholmod_dense right{};
  right.nrow = right.d = static_cast<std::size_t>(b.rows());
  right.ncol = static_cast<std::size_t>(b.cols());
  right.nzmax = static_cast<std::size_t>(b.size());
  right.x = const_cast<double*>(b.data());  // CHOLMOD reads it
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  auto& f = *factors_;
  const SingleThreadedBlas single_threaded;
  const int is_done = cholmod_solve2(CHOLMOD_A, f.factor, &right, nullptr, &f.solution, nullptr,
                                     &f.first_work, &f.second_work, &f.common);
  f.check(is_done != 0, "cholmod_solve2");
  return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(f.solution->x), b.rows(),
                                           b.cols());
}

#endif

SupernodalCholesky::~SupernodalCholesky() = default;
SupernodalCholesky::SupernodalCholesky(SupernodalCholesky&&) noexcept = default;
SupernodalCholesky& SupernodalCholesky::operator=(SupernodalCholesky&&) noexcept = default;

}  // namespace vesica::linalg
