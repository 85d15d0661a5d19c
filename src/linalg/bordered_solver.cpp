#include "vesica/linalg/bordered_solver.hpp"

#include <span>

#include "vesica/core/error.hpp"

namespace vesica::linalg {

namespace {

std::span<const double> view(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}
std::span<double> view(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

}  // namespace

Eigen::VectorXd BorderedMatrix::multiply(const Eigen::VectorXd& x) const {
  const auto n = columns.rows();
  const auto m = columns.cols();
  const Eigen::VectorXd head = x.head(n);
  Eigen::VectorXd product(n);
  block.multiply(view(head), view(product));
  Eigen::VectorXd result(n + m);
  result.head(n) = product + columns * x.tail(m);
  result.tail(m) = rows * head;
  if (corner.size() > 0) result.tail(m) += corner * x.tail(m);
  return result;
}

BorderedSolver::BorderedSolver(DirectSolverKind kind, const BorderedMatrix& matrix, int block_size)
    : direct_(make_direct_solver(kind, matrix.block, block_size)) {}

void BorderedSolver::factorise(const BorderedMatrix& matrix) {
  direct_->factorise(matrix.block);
  rows_ = matrix.rows;
  solved_columns_.resize(matrix.columns.rows(), matrix.columns.cols());
  for (Eigen::Index k = 0; k < matrix.columns.cols(); ++k) {
    const Eigen::VectorXd column = matrix.columns.col(k);
    Eigen::VectorXd solved(column.size());
    direct_->solve(view(column), view(solved));
    solved_columns_.col(k) = solved;
  }
  Eigen::MatrixXd schur = rows_ * solved_columns_;
  if (matrix.corner.size() > 0) schur -= matrix.corner;
  if (!schur_.factorise(schur))
    throw RecoverableError("bordered matrix: the constraints are not independent");
}

Eigen::VectorXd BorderedSolver::solve(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd head = b.head(solved_columns_.rows());
  Eigen::VectorXd x(head.size());
  direct_->solve(view(head), view(x));
  return join(x, b);
}

Eigen::VectorXd BorderedSolver::precondition(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd head = b.head(solved_columns_.rows());
  Eigen::VectorXd x(head.size());
  direct_->precondition(view(head), view(x));
  return join(x, b);
}

Eigen::VectorXd BorderedSolver::join(const Eigen::VectorXd& head, const Eigen::VectorXd& b) const {
  const auto m = solved_columns_.cols();
  Eigen::VectorXd x(head.size() + m);
  x.tail(m) = m > 0 ? Eigen::VectorXd(schur_.solve(rows_ * head - b.tail(m))) : Eigen::VectorXd();
  x.head(head.size()) = head - solved_columns_ * x.tail(m);
  return x;
}

}  // namespace vesica::linalg
