#include "solve/reduced_preconditioner.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

#include "block_matrices.hpp"
#include "relaxation_cases.hpp"

namespace vesica::solve {
namespace {

/// Iterations of GMRES without restart, preconditioned on the left, until the residual has fallen
/// by `tolerance`.
template <class Operator>
int krylov_iterations(const Operator& apply, const Eigen::VectorXd& b, double tolerance) {
  constexpr int most = 60;
  Eigen::MatrixXd basis(b.size(), most + 1);
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(most + 1, most);
  basis.col(0) = b.normalized();
  for (int k = 0; k < most; ++k) {
    Eigen::VectorXd next = apply(basis.col(k));
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd parts = basis.leftCols(k + 1).transpose() * next;
      hessenberg.col(k).head(k + 1) += parts;
      next -= basis.leftCols(k + 1) * parts;
    }
    hessenberg(k + 1, k) = next.norm();
    basis.col(k + 1) = next.normalized();
    const Eigen::MatrixXd h = hessenberg.topLeftCorner(k + 2, k + 1);
    const Eigen::VectorXd first = Eigen::VectorXd::Unit(k + 2, 0);
    const Eigen::VectorXd x = h.colPivHouseholderQr().solve(first);
    if ((h * x - first).norm() <= tolerance) return k + 1;
  }
  return most;
}

/// For the Jacobian of the start of Table 1 with m = `resolution` and a step of 1 / cj.
int iterations_of_start(int resolution, double cj) {
  const auto c = test::table_1_case(resolution);
  const problem::ReducedProblem problem(c.start.triangulation, c.model, c.start.values.positions,
                                        0);
  ReducedPreconditioner preconditioner(problem, problem::scales_of(c.model, c.start));
  const auto y = problem.initial_values(c.start);
  const auto point = problem.point(0, y);
  const auto there = problem.linearise({1, 100}, point, Eigen::VectorXd::Zero(y.size()));
  const problem::JacobianWeights weights{1, cj};
  preconditioner.set_up(point, there, weights);
  std::mt19937 engine(3);
  Eigen::VectorXd b = linalg::random_vector(y.size(), engine);
  b.tail(problem.num_multipliers()).setZero();
  return krylov_iterations(
      [&](const Eigen::VectorXd& v) {
        return preconditioner.solve(problem.product(point, there, weights, v));
      },
      preconditioner.solve(b), 1e-4);
}

TEST(ReducedPreconditioner, NeedsNoMoreIterationsOnFinerMeshes) {
  for (const double cj : {1e1, 1e3, 1e5}) {
    const int coarse = iterations_of_start(2, cj);
    const int fine = iterations_of_start(6, cj);
    SCOPED_TRACE(fmt::format("cj {}: {} and {} iterations", cj, coarse, fine));
    EXPECT_LE(fine, coarse + 2);
    EXPECT_LE(fine, 20);
    EXPECT_GT(fine, 1);
  }
}

TEST(ReducedPreconditioner, IsNearlyTheInverseOfTheMetricForInitialRates) {
  const auto c = test::table_1_case(4);
  const problem::ReducedProblem problem(c.start.triangulation, c.model, c.start.values.positions,
                                        0);
  ReducedPreconditioner preconditioner(problem, problem::scales_of(c.model, c.start));
  const auto y = problem.initial_values(c.start);
  const auto point = problem.point(0, y);
  const auto there = problem.linearise({1, 100}, point, Eigen::VectorXd::Zero(y.size()));
  preconditioner.set_up(point, there, {0, 1});
  std::mt19937 engine(3);
  const Eigen::VectorXd v = linalg::random_vector(y.size(), engine);
  const Eigen::VectorXd image = preconditioner.solve(problem.product(point, there, {0, 1}, v));
  EXPECT_LE((image - v).norm(), 0.2 * v.norm());
}

}  // namespace
}  // namespace vesica::solve
