#include "inner_minimisation.hpp"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <exception>
#include <memory>

namespace vesica::minimise {

namespace {

/// Hands the evaluations on; exceptions wait here until Ceres has returned.
class Objective final : public ceres::FirstOrderFunction {
 public:
  Objective(AugmentedEnergy& energy, std::exception_ptr& fatal) : energy_(energy), fatal_(fatal) {}

  bool Evaluate(const double* y, double* cost, double* gradient) const override {
    if (fatal_) return false;
    try {
      return energy_.evaluate(Eigen::Map<const Eigen::VectorXd>(y, NumParameters()), *cost,
                              gradient);
    } catch (...) {
      fatal_ = std::current_exception();
      return false;
    }
  }
  [[nodiscard]] int NumParameters() const override {
    return static_cast<int>(energy_.last_variables().size());
  }

 private:
  AugmentedEnergy& energy_;
  std::exception_ptr& fatal_;
};

class EndOfInner final : public ceres::IterationCallback {
 public:
  EndOfInner(const AugmentedEnergy& energy, const InnerLimits& limits, Eigen::Index num_nodes)
      : energy_(energy), limits_(limits), num_nodes_(num_nodes) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const double move = energy_.last().unknowns.head(num_nodes_).cwiseAbs().maxCoeff();
    const bool is_done =
        summary.gradient_norm < limits_.gradient || (summary.iteration > 0 && move > limits_.move);
    return is_done ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const AugmentedEnergy& energy_;
  const InnerLimits& limits_;
  Eigen::Index num_nodes_;
};

ceres::GradientProblemSolver::Options solver_options(const InnerLimits& limits) {
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::LBFGS;
  options.line_search_type = ceres::WOLFE;
  options.max_lbfgs_rank = limits.iterations;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = 0;
  options.parameter_tolerance = 0;
  options.gradient_tolerance = 0;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

InnerResult minimise_inner(const InnerProblem& problem, const GraphPoint& start,
                           const InnerLimits& limits) {
  AugmentedEnergy energy(problem, start);
  const double start_value = energy.value(start.sample);
  std::exception_ptr fatal;
  EndOfInner callback(energy, limits, problem.graph.reference.rows());
  auto options = solver_options(limits);
  options.callbacks.push_back(&callback);
  const ceres::GradientProblem function(std::make_unique<Objective>(energy, fatal).release());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.coordinates.size());
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, function, y.data(), &summary);
  if (fatal) std::rethrow_exception(fatal);
  double value = start_value;
  InnerResult result;
  if (!energy.evaluate(y, value, nullptr)) value = start_value;
  result.point = energy.last();
  result.iterations = static_cast<long>(summary.iterations.size()) - 1;
  result.evaluations = energy.evaluations();
  result.refusals = energy.refusals();
  result.decrease = start_value - value;
  result.seconds = energy.seconds();
  return result;
}

}  // namespace vesica::minimise
