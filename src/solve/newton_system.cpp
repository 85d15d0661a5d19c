#include "newton_system.hpp"

#include "reduced_preconditioner.hpp"

namespace vesica::solve {

struct NewtonSystem::Assembled {
  const problem::AssembledProblem& problem;
  linalg::BorderedMatrix matrix;
  linalg::BorderedSolver solver;
};

/// The last point is kept: IDA asks for residual, product and values at the same (t, y), and the
/// moment of the last one is a good guess of the next.
struct NewtonSystem::Reduced {
  const problem::ReducedProblem& problem;
  ReducedPreconditioner preconditioner;
  problem::ReducedPoint point;
  problem::ReducedLinearisation there;

  void move_to(double time, const Eigen::VectorXd& y) {
    if (point.time == time && point.y.size() == y.size() && point.y == y) return;
    point = problem.point(time, y, point.fields.moment);
  }
};

NewtonSystem::NewtonSystem(const problem::AssembledProblem& problem, linalg::DirectSolverKind kind)
    : problem_(problem) {
  auto matrix = problem.make_matrix();
  linalg::BorderedSolver solver(kind, matrix, problem.block_size());
  assembled_.reset(new Assembled{problem, std::move(matrix), std::move(solver)});
}

NewtonSystem::NewtonSystem(const problem::ReducedProblem& problem, const problem::Scales& scales)
    : problem_(problem),
      reduced_(new Reduced{problem, ReducedPreconditioner(problem, scales), {}, {}}) {}

NewtonSystem::~NewtonSystem() = default;

Eigen::VectorXd NewtonSystem::residual(const problem::EquationSettings& settings, double time,
                                       const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  const ScopedTimer timer(seconds_.residual);
  ++counts_.residuals;
  if (!reduced_) return problem_.residual(settings, time, y, y_rate);
  reduced_->move_to(time, y);
  return reduced_->problem.residual(settings, reduced_->point, y_rate);
}

void NewtonSystem::set_up(const problem::EquationSettings& settings,
                          const problem::JacobianWeights& weights, double time,
                          const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  if (reduced_) {
    linearise(settings, time, y, y_rate);
  } else {
    const ScopedTimer timer(seconds_.jacobian);
    ++counts_.jacobians;
    assembled_->problem.jacobian(settings, weights, time, y, y_rate, assembled_->matrix);
  }
  const ScopedTimer timer(seconds_.factorisation);
  ++counts_.factorisations;
  if (reduced_) {
    reduced_->preconditioner.set_up(reduced_->point, reduced_->there, weights);
  } else {
    assembled_->solver.factorise(assembled_->matrix);
  }
}

Eigen::VectorXd NewtonSystem::solve(const Eigen::VectorXd& b) {
  const ScopedTimer timer(seconds_.solve);
  return reduced_ ? reduced_->preconditioner.solve(b) : assembled_->solver.solve(b);
}

Eigen::VectorXd NewtonSystem::precondition(const Eigen::VectorXd& b) {
  const ScopedTimer timer(seconds_.solve);
  return reduced_ ? reduced_->preconditioner.solve(b) : assembled_->solver.precondition(b);
}

Eigen::VectorXd NewtonSystem::solve_accurately(const Eigen::VectorXd& b) {
  const ScopedTimer timer(seconds_.solve);
  const Eigen::VectorXd x = assembled_->solver.solve(b);
  return x + assembled_->solver.solve(b - assembled_->matrix.multiply(x));
}

void NewtonSystem::linearise(const problem::EquationSettings& settings, double time,
                             const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate) {
  const ScopedTimer timer(seconds_.jacobian);
  ++counts_.jacobians;
  reduced_->move_to(time, y);
  reduced_->there = reduced_->problem.linearise(settings, reduced_->point, y_rate);
}

Eigen::VectorXd NewtonSystem::product(const problem::JacobianWeights& weights,
                                      const Eigen::VectorXd& v) {
  const ScopedTimer timer(seconds_.jacobian);
  return reduced_->problem.product(reduced_->point, reduced_->there, weights, v);
}

problem::Fields NewtonSystem::values(double time, const Eigen::VectorXd& y) {
  if (!reduced_) return problem_.values(time, y);
  reduced_->move_to(time, y);
  return reduced_->problem.values(reduced_->point);
}

std::optional<model::EnergyParts> NewtonSystem::energy(double time, const Eigen::VectorXd& y) {
  if (!reduced_) return problem_.energy(time, y);
  reduced_->move_to(time, y);
  return reduced_->problem.energy_problem().energy(reduced_->point.fields);
}

}  // namespace vesica::solve
