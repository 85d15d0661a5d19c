#include "reduced_hessian.hpp"

#include "vesica/core/parallel.hpp"

namespace vesica::minimise {

namespace {

constexpr Eigen::Index displacement = 3;  // place in the block of a node, behind p

std::size_t at(linalg::SparseIndex i) { return static_cast<std::size_t>(i); }

/// -K_pp, which is the same for the three components of p.
linalg::SparseMatrix mass_of(const problem::EnergyProblem& problem,
                             const linalg::SparseMatrix& matrix, Eigen::Index block) {
  linalg::SparseMatrix mass = problem.graph().block_pattern(1);
  for (linalg::SparseIndex node = 0; node < mass.size; ++node) {
    auto entry = matrix.column_starts[at(node * block)];
    for (auto pair = mass.column_starts[at(node)]; pair < mass.column_starts[at(node + 1)];
         ++pair, entry += block)
      mass.values[at(pair)] = -matrix.values[at(entry)];
  }
  return mass;
}

}  // namespace

ReducedHessian::ReducedHessian(const problem::EnergyProblem& problem,
                               const problem::EnergyFields& fields,
                               const problem::Multipliers& multipliers,
                               const problem::NormalGraph& graph, int threads)
    : num_nodes_(problem.triangulation().num_nodes()),
      block_(problem.model().is_two_phase ? 5 : 4),
      threads_(resolved_threads(threads)),
      matrix_(problem.graph().block_pattern(static_cast<int>(block_))),
      mass_(problem.graph().block_pattern(1)) {
  problem.hessian(fields, multipliers, {}, graph.directions, {1, 0}, matrix_);
  mass_.factorise(mass_of(problem, matrix_, block_));
}

Eigen::VectorXd ReducedHessian::times(const Eigen::VectorXd& u) const {
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(block_, num_nodes_);
  y.row(displacement) = u.head(num_nodes_).transpose();
  if (block_ > 4) y.row(displacement + 1) = u.tail(num_nodes_).transpose();
  const Eigen::MatrixXd without_moment = product(y.reshaped()).reshaped(block_, num_nodes_);
  for (Eigen::Index k = 0; k < displacement; ++k)
    y.row(k) = mass_.solve(without_moment.row(k).transpose()).transpose();
  const Eigen::MatrixXd all = product(y.reshaped()).reshaped(block_, num_nodes_);
  Eigen::VectorXd result(u.size());
  result.head(num_nodes_) = all.row(displacement).transpose();
  if (block_ > 4) result.tail(num_nodes_) = all.row(displacement + 1).transpose();
  return result;
}

/// By the columns of K, which is symmetric.
Eigen::VectorXd ReducedHessian::product(const Eigen::VectorXd& y) const {
  Eigen::VectorXd result(y.size());
  parallel_for(static_cast<int>(matrix_.size), threads_, [&](int begin, int end) {
    for (int column = begin; column < end; ++column) {
      double sum = 0;
      for (auto k = matrix_.column_starts[at(column)]; k < matrix_.column_starts[at(column + 1)];
           ++k)
        sum += matrix_.values[at(k)] * y[matrix_.rows[at(k)]];
      result[column] = sum;
    }
  });
  return result;
}

}  // namespace vesica::minimise
