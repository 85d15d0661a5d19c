#include "mumps_solver.hpp"

#include <fmt/format.h>
#include <smumps_c.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "blas_threads.hpp"
#include "node_ordering.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {

namespace {

enum Job { start = -1, finish = -2, analysis = 1, factorisation = 2, solution = 3 };

// Numbers of the users' guide of MUMPS.
constexpr int serial = -987654;  // communicator
constexpr std::size_t last_output = 4;
constexpr std::size_t ordering = 7;
constexpr int given_ordering = 1;
constexpr std::size_t own_scaling = 8;
constexpr std::size_t more_memory = 14;  // per cent of the estimate
constexpr int singular = -10;
constexpr int too_little_memory = -9;

constexpr int equilibration_sweeps = 4;
constexpr int first_more_memory = 40;
constexpr int last_more_memory = 1000;
constexpr int max_refinements = 10;
constexpr double round_off = 1e-14;  // of the residual over the right-hand side
constexpr double good_digits = 1e-10;
constexpr double few_digits = 1e-5;  // of a preconditioner: border columns are solved with it

/// The power of two next to x^(-1/2).
double inverse_root(double x) { return std::exp2(-std::round(std::log2(x) / 2)); }

std::span<double> view(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

class MumpsSolver final : public DirectSolver {
 public:
  MumpsSolver(const SparseMatrix& matrix, int block_size)
      : matrix_(matrix), block_size_(block_size) {
    mumps_.par = 1;
    mumps_.comm_fortran = serial;
    run(start, "start");
    std::fill_n(mumps_.icntl, last_output, 0);
    control(ordering) = given_ordering;
    control(own_scaling) = 0;
    control(more_memory) = first_more_memory;
    const auto order = node_ordering(matrix, block_size);
    places_.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      places_[static_cast<std::size_t>(order[k])] = static_cast<MUMPS_INT>(k + 1);
    rows_.assign(matrix.rows.begin(), matrix.rows.end());
    for (auto& row : rows_) ++row;
    columns_.reserve(rows_.size());
    for (std::size_t j = 1; j < matrix.column_starts.size(); ++j) {
      const auto count = matrix.column_starts[j] - matrix.column_starts[j - 1];
      columns_.insert(columns_.end(), static_cast<std::size_t>(count), static_cast<MUMPS_INT>(j));
    }
    values_.resize(rows_.size());
    mumps_.n = static_cast<MUMPS_INT>(matrix.size);
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    mumps_.a = values_.data();
    mumps_.perm_in = places_.data();
    run(analysis, "analysis");
  }
  ~MumpsSolver() override {
    mumps_.job = finish;
    smumps_c(&mumps_);
  }

  void factorise(const SparseMatrix& matrix) override {
    matrix_.values = matrix.values;
    if (exact_) return exact_->factorise(matrix_);
    equilibrate();
    for (std::size_t k = 0; k < values_.size(); ++k) {
      values_[k] =
          static_cast<float>(row_scales_[row(k)] * matrix.values[k] * column_scales_[column(k)]);
    }
    const SingleThreadedBlas single_threaded;
    run(factorisation, "factorisation");
  }

  /// Refines the single-precision solution until the residual is at round-off or stops to fall.
  void solve(std::span<const double> b, std::span<double> x) const override {
    if (exact_ || !refine(b, x, round_off, good_digits)) exact().solve(b, x);
  }

  void precondition(std::span<const double> b, std::span<double> x) const override {
    if (exact_ || !refine(b, x, few_digits, few_digits)) exact().precondition(b, x);
  }

 private:
  [[nodiscard]] MUMPS_INT& control(std::size_t number) const { return mumps_.icntl[number - 1]; }

  [[nodiscard]] std::size_t row(std::size_t k) const {
    return static_cast<std::size_t>(rows_[k] - 1);
  }
  [[nodiscard]] std::size_t column(std::size_t k) const {
    return static_cast<std::size_t>(columns_[k] - 1);
  }

  /// Factors in double precision, once single precision has failed: near an equilibrium the matrix
  /// is nearly singular but for its border.
  [[nodiscard]] DirectSolver& exact() const {
    if (!exact_) {
      exact_ = make_direct_solver(default_direct_solver, matrix_, block_size_);
      exact_->factorise(matrix_);
    }
    return *exact_;
  }

  /// Solves again for the residual, in equilibrated rows, until that is below `wanted` or stops to
  /// fall. Tells whether it is below `needed`.
  [[nodiscard]] bool refine(std::span<const double> b, std::span<double> x, double wanted,
                            double needed) const {
    const auto n = static_cast<Eigen::Index>(b.size());
    const Eigen::Map<const Eigen::VectorXd> right(b.data(), n);
    const Eigen::Map<const Eigen::VectorXd> rows(row_scales_.data(), n);
    Eigen::Map<Eigen::VectorXd> result(x.data(), n);
    Eigen::VectorXd residual = right;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd change(n);
    Eigen::VectorXd product(n);
    const double whole = rows.cwiseProduct(right).norm();
    double size = whole;
    result = sum;
    for (int k = 0; k < max_refinements && size > wanted * whole; ++k) {
      solve_once(view(residual), view(change));
      sum += change;
      matrix_.multiply(view(sum), view(product));
      residual = right - product;
      const double now = rows.cwiseProduct(residual).norm();
      if (!(now < size)) break;
      result = sum;
      size = now;
    }
    return size <= needed * whole;
  }

  /// In single precision.
  void solve_once(std::span<const double> b, std::span<double> x) const {
    double size = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
      size = std::max(size, std::abs(row_scales_[i] * b[i]));
    std::fill(x.begin(), x.end(), 0);
    if (size == 0) return;
    right_.resize(b.size());
    for (std::size_t i = 0; i < b.size(); ++i)
      right_[i] = static_cast<float>(row_scales_[i] * b[i] / size);
    mumps_.rhs = right_.data();
    const SingleThreadedBlas single_threaded;
    run(solution, "solution");
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = size * column_scales_[i] * static_cast<double>(right_[i]);
  }

  /// Scales rows and columns by powers of two until the largest entry of each is near 1 (Ruiz
  /// 2001), so that the factors do not depend on the units of the case.
  void equilibrate() {
    const auto n = static_cast<std::size_t>(matrix_.size);
    row_scales_.assign(n, 1);
    column_scales_.assign(n, 1);
    std::vector<double> of_rows(n);
    std::vector<double> of_columns(n);
    for (int sweep = 0; sweep < equilibration_sweeps; ++sweep) {
      std::fill(of_rows.begin(), of_rows.end(), 0);
      std::fill(of_columns.begin(), of_columns.end(), 0);
      for (std::size_t k = 0; k < values_.size(); ++k) {
        const double size =
            std::abs(row_scales_[row(k)] * matrix_.values[k] * column_scales_[column(k)]);
        if (!std::isfinite(size))
          throw RecoverableError("MUMPS: the matrix holds a value that is not finite");
        of_rows[row(k)] = std::max(of_rows[row(k)], size);
        of_columns[column(k)] = std::max(of_columns[column(k)], size);
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (of_rows[i] == 0 || of_columns[i] == 0)
          throw RecoverableError("MUMPS: a row or column of the matrix is zero");
        row_scales_[i] *= inverse_root(of_rows[i]);
        column_scales_[i] *= inverse_root(of_columns[i]);
      }
    }
  }

  /// Calls MUMPS, with more memory while its estimate of the fill was too small.
  void run(Job job, std::string_view what) const {
    mumps_.job = job;
    smumps_c(&mumps_);
    while (mumps_.infog[0] == too_little_memory && control(more_memory) < last_more_memory) {
      control(more_memory) *= 2;
      smumps_c(&mumps_);
    }
    const auto code = mumps_.infog[0];
    if (code >= 0) return;
    const auto text = fmt::format("MUMPS, {}: error {} ({})", what, code, mumps_.infog[1]);
    if (code == singular) throw RecoverableError(text);
    throw SolverError(text);
  }

  SparseMatrix matrix_;
  int block_size_;
  mutable std::unique_ptr<DirectSolver> exact_;
  std::vector<double> row_scales_;
  std::vector<double> column_scales_;
  std::vector<MUMPS_INT> rows_;
  std::vector<MUMPS_INT> columns_;
  std::vector<MUMPS_INT> places_;
  std::vector<float> values_;
  mutable SMUMPS_STRUC_C mumps_{};  // a solution writes to it
  mutable std::vector<float> right_;
};

}  // namespace

std::unique_ptr<DirectSolver> make_mumps_solver(const SparseMatrix& matrix, int block_size) {
  return std::make_unique<MumpsSolver>(matrix, block_size);
}

}  // namespace vesica::linalg
