#include "reduced_preconditioner.hpp"

#include <algorithm>

#include "linalg/blas_threads.hpp"
#include "problem/energy/nodal_operator.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::solve {

using problem::OperatorWeights;

ReducedPreconditioner::ReducedPreconditioner(const problem::ReducedProblem& problem,
                                             const problem::Scales& scales)
    : problem_(problem),
      shift_(2 / (scales.length * scales.length)),
      bending_(problem.energy_problem().graph().block_pattern(1)),
      phase_(problem.energy_problem().graph().block_pattern(1), bending_) {}

namespace {

/// Does both at the same time where there are two threads; the dense blocks take one each.
template <class First, class Second>
void do_both(int threads, const First& first, const Second& second) {
  const linalg::SingleThreadedBlas single_threaded;
  parallel_for(2, std::min(threads, 2), [&](int begin, int end) {
    if (begin == 0) first();
    if (end == 2) second();
  });
}

}  // namespace

linalg::SparseMatrix ReducedPreconditioner::bending_operator(
    const problem::ReducedPoint& point, const problem::JacobianWeights& weights) {
  const auto& energy = problem_.energy_problem();
  const auto material = problem_.model().material.at(point.time);
  const auto& directions = problem_.graph().directions;
  const auto operator_with = [&](auto&& weights_at) {
    return assemble_operator(energy, point.fields, directions, problem_.threads(), weights_at);
  };
  if (is_metric_) {
    return operator_with([&](const Pack&, const Pack& cosine) {
      return OperatorWeights{0.0, weights.rate * cosine * cosine};
    });
  }
  mass_ = operator_with([](const Pack&, const Pack&) { return OperatorWeights{0.0, 1.0}; });
  return operator_with([&](const Pack& c, const Pack& cosine) {
    const Pack root = sqrt(model::interpolate(material.bending_rigidity, c));
    return OperatorWeights{cosine * root, cosine * max(std::sqrt(weights.rate), shift_ * root)};
  });
}

/// The second derivative of the double well, 6 c^2 - 2 with its factor, is negative in the
/// interface: held above a part of the other terms.
linalg::SparseMatrix ReducedPreconditioner::phase_operator(
    const problem::ReducedPoint& point, const problem::JacobianWeights& weights) const {
  const auto material = problem_.model().material.at(point.time);
  const double sigma = material.line_tension;
  const double eps = material.interface_width;
  const double mobility = weights.rate * eps * material.kinetic_coefficient;
  const double floor = std::max(0.5 * mobility, 0.5 * sigma / eps);
  return assemble_operator(problem_.energy_problem(), point.fields, problem_.graph().directions,
                           problem_.threads(), [&](const Pack& c, const Pack&) {
                             if (is_metric_) return OperatorWeights{0.0, mobility};
                             return OperatorWeights{
                                 sigma * eps,
                                 max(mobility + sigma / eps * (6.0 * c * c - 2.0), floor)};
                           });
}

void ReducedPreconditioner::set_up(const problem::ReducedPoint& point,
                                   const problem::ReducedLinearisation& there,
                                   const problem::JacobianWeights& weights) {
  is_metric_ = weights.value == 0;
  const auto bending = bending_operator(point, weights);
  if (problem_.model().is_two_phase) {
    const auto phase = phase_operator(point, weights);
    do_both(
        problem_.threads(), [&] { bending_.factorise(bending); }, [&] { phase_.factorise(phase); });
  } else {
    bending_.factorise(bending);
  }
  rows_ = problem_.border_rows(there, weights);
  solved_columns_ = solve_nodal(there.columns);
  Eigen::MatrixXd schur = rows_ * solved_columns_;
  for (Eigen::Index k = 0; k < schur.cols(); ++k) {
    if (there.columns.col(k).isZero(0)) schur(k, k) -= 1;  // no such rigid motion: mu_k = 0
  }
  if (!schur_.factorise(schur))
    throw RecoverableError("preconditioner: the constraints are not independent");
}

Eigen::MatrixXd ReducedPreconditioner::solve_nodal(const Eigen::MatrixXd& b) const {
  const auto n = problem_.num_nodes();
  if (!problem_.model().is_two_phase) return solve_bending(b);
  Eigen::MatrixXd x(b.rows(), b.cols());
  do_both(
      problem_.threads(), [&] { x.topRows(n) = solve_bending(b.topRows(n)); },
      [&] { x.bottomRows(n) = phase_.solve(b.bottomRows(n)); });
  return x;
}

/// T^-1 M T^-1 b, of the flow's metric alone one inverse.
Eigen::MatrixXd ReducedPreconditioner::solve_bending(const Eigen::MatrixXd& b) const {
  Eigen::MatrixXd x = bending_.solve(b);
  if (is_metric_) return x;
  const auto size = static_cast<std::size_t>(x.rows());
  Eigen::VectorXd product(x.rows());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    mass_.multiply({x.col(k).data(), size}, {product.data(), size});
    x.col(k) = product;
  }
  return bending_.solve(x);
}

Eigen::VectorXd ReducedPreconditioner::solve(const Eigen::VectorXd& b) const {
  const auto n = solved_columns_.rows();
  const auto m = solved_columns_.cols();
  Eigen::VectorXd x(n + m);
  const Eigen::VectorXd head = solve_nodal(b.head(n));
  x.tail(m) = schur_.solve(rows_ * head - b.tail(m));
  x.head(n) = head - solved_columns_ * x.tail(m);
  return x;
}

}  // namespace vesica::solve
