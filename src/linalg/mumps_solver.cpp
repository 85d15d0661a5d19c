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
constexpr std::size_t more_memory = 14;  // per cent of the estimate
constexpr int singular = -10;
constexpr int too_little_memory = -9;

constexpr int first_more_memory = 40;
constexpr int last_more_memory = 1000;
constexpr int max_refinements = 10;
constexpr double round_off = 1e-14;  // of the residual over the right-hand side

std::span<double> view(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

class MumpsSolver final : public DirectSolver {
 public:
  MumpsSolver(const SparseMatrix& matrix, int block_size) : matrix_(matrix) {
    mumps_.par = 1;
    mumps_.comm_fortran = serial;
    run(start, "start");
    std::fill_n(mumps_.icntl, last_output, 0);
    control(ordering) = given_ordering;
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
    scale_ = 0;
    for (const double value : matrix.values) {
      if (!std::isfinite(value))
        throw RecoverableError("MUMPS: the matrix holds a value that is not finite");
      scale_ = std::max(scale_, std::abs(value));
    }
    if (scale_ == 0) throw RecoverableError("MUMPS: the matrix is zero");
    std::transform(matrix.values.begin(), matrix.values.end(), values_.begin(),
                   [&](double value) { return static_cast<float>(value / scale_); });
    const SingleThreadedBlas single_threaded;
    run(factorisation, "factorisation");
  }

  /// Refines the single-precision solution until the residual is at round-off or stops to fall.
  void solve(std::span<const double> b, std::span<double> x) const override {
    const auto n = static_cast<Eigen::Index>(b.size());
    const Eigen::Map<const Eigen::VectorXd> right(b.data(), n);
    Eigen::Map<Eigen::VectorXd> result(x.data(), n);
    Eigen::VectorXd residual = right;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd change(n);
    Eigen::VectorXd product(n);
    double size = residual.norm();
    result = sum;
    for (int k = 0; k < max_refinements && size > round_off * right.norm(); ++k) {
      precondition(view(residual), view(change));
      sum += change;
      matrix_.multiply(view(sum), view(product));
      residual = right - product;
      const double now = residual.norm();
      if (!(now < size)) break;
      result = sum;
      size = now;
    }
  }

  void precondition(std::span<const double> b, std::span<double> x) const override {
    double size = 0;
    for (const double value : b) size = std::max(size, std::abs(value));
    std::fill(x.begin(), x.end(), 0);
    if (size == 0) return;
    right_.resize(b.size());
    std::transform(b.begin(), b.end(), right_.begin(),
                   [&](double value) { return static_cast<float>(value / size); });
    mumps_.rhs = right_.data();
    const SingleThreadedBlas single_threaded;
    run(solution, "solution");
    std::transform(right_.begin(), right_.end(), x.begin(),
                   [&](float value) { return size / scale_ * static_cast<double>(value); });
  }

 private:
  [[nodiscard]] MUMPS_INT& control(std::size_t number) const { return mumps_.icntl[number - 1]; }

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
  double scale_ = 1;  // of the values: those of single precision end at 1e38
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
