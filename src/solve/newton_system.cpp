#include "newton_system.hpp"

namespace vesica::solve {

NewtonSystem::NewtonSystem(const problem::FlowProblem& problem, linalg::DirectSolverKind kind)
    : problem_(problem),
      matrix_(problem.make_matrix()),
      solver_(kind, matrix_, problem.block_size()) {}

Eigen::VectorXd NewtonSystem::residual(const problem::EquationSettings& settings, double time,
                                       const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  const ScopedTimer timer(seconds_.residual);
  ++counts_.residuals;
  return problem_.residual(settings, time, y, y_rate);
}

void NewtonSystem::set_up(const problem::EquationSettings& settings,
                          const problem::JacobianWeights& weights, double time,
                          const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  {
    const ScopedTimer timer(seconds_.jacobian);
    ++counts_.jacobians;
    problem_.jacobian(settings, weights, time, y, y_rate, matrix_);
  }
  const ScopedTimer timer(seconds_.factorisation);
  ++counts_.factorisations;
  solver_.factorise(matrix_);
}

Eigen::VectorXd NewtonSystem::solve(const Eigen::VectorXd& b) {
  const ScopedTimer timer(seconds_.solve);
  return solver_.solve(b);
}

Eigen::VectorXd NewtonSystem::solve_accurately(const Eigen::VectorXd& b) {
  const ScopedTimer timer(seconds_.solve);
  const Eigen::VectorXd x = solver_.solve(b);
  return x + solver_.solve(b - matrix_.multiply(x));
}

}  // namespace vesica::solve
