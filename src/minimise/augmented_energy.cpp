#include "augmented_energy.hpp"

#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"

namespace vesica::minimise {

AugmentedEnergy::AugmentedEnergy(const InnerProblem& problem, const GraphPoint& start)
    : problem_(problem),
      start_(start),
      last_(start),
      last_variables_(Eigen::VectorXd::Zero(problem.coordinates.size())) {}

bool AugmentedEnergy::evaluate(const Eigen::VectorXd& y, double& value_at_y,
                               double* gradient_at_y) {
  if (y != last_variables_ && !visit(y)) {
    ++refusals_;
    return false;
  }
  value_at_y = value(last_.sample);
  if (gradient_at_y != nullptr) {
    const ScopedTimer timer(seconds_.solve);
    Eigen::Map<Eigen::VectorXd>(gradient_at_y, y.size()) =
        problem_.coordinates.pull_back(gradient(last_.sample)) / problem_.energy_unit;
  }
  return true;
}

bool AugmentedEnergy::visit(const Eigen::VectorXd& y) {
  const auto n = problem_.graph.reference.rows();
  Eigen::VectorXd unknowns = start_.unknowns;
  {
    const ScopedTimer timer(seconds_.solve);
    unknowns += problem_.coordinates.change(y);
  }
  if (!(unknowns.head(n).cwiseAbs().maxCoeff() <= problem_.largest_move)) return false;
  try {
    ++evaluations_;
    const ScopedTimer timer(seconds_.residual);
    last_.sample = sample_energy(problem_.energy, positions_of(problem_.graph, unknowns),
                                 order_parameter_of(problem_.graph, unknowns));
  } catch (const RecoverableError&) {
    last_ = start_;
    last_variables_.setZero();
    return false;
  }
  last_.unknowns = unknowns;
  last_variables_ = y;
  return true;
}

double AugmentedEnergy::value(const EnergySample& sample) const {
  const Eigen::VectorXd errors = problem_.constraints.errors(sample.constraints);
  return (sample.energy.total() + problem_.multipliers.dot(errors) +
          0.5 * problem_.weights.dot(errors.cwiseAbs2())) /
         problem_.energy_unit;
}

Eigen::VectorXd AugmentedEnergy::gradient(const EnergySample& sample) const {
  const Eigen::VectorXd errors = problem_.constraints.errors(sample.constraints);
  return problem_.constraints.lagrangian_gradient(
      problem_.graph, sample, problem_.multipliers + problem_.weights.cwiseProduct(errors),
      problem_.energy.model().is_two_phase);
}

}  // namespace vesica::minimise
