#include "vesica/solve/polish.hpp"

#include <fmt/format.h>

#include <limits>

#include "lanczos.hpp"
#include "newton_system.hpp"
#include "vesica/core/check.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/problem/variational_problem.hpp"

namespace vesica::solve {

namespace {

constexpr int max_iterations = 20;
constexpr int max_halvings = 6;
constexpr double gradient_tolerance = 1e-10;  // |dL| / |dE|; Newton's last step goes far below 1e-8
constexpr double constraint_tolerance = 1e-12;
constexpr double largest_displacement = 0.1;  // in a step, of R_c

/// The shift of the inverse iteration, in 1/time: above the fastest growth to be expected.
constexpr double shift = 100;
constexpr int min_krylov_dimension = 20;  // a start poor in the lowest mode may stall before
constexpr int krylov_dimension = 80;
constexpr double eigenvalue_tolerance = 1e-6;

problem::EquationSettings at_rest() {
  problem::EquationSettings settings;
  settings.form = problem::ConstraintForm::original;
  return settings;
}

/// The equations of the equilibrium on one normal graph.
class Optimality {
 public:
  Optimality(const SolverOptions& options, const model::Model& model, const problem::State& state,
             const mesh::Positions& reference)
      : scales_(problem::scales_of(model, state)),
        time_(state.time),
        problem_(state.triangulation, model, reference, options.threads),
        system_(problem_, options.direct_solver()),
        y_(problem_.initial_values(state)),
        rest_(Eigen::VectorXd::Zero(y_.size())) {}

  [[nodiscard]] const problem::VariationalProblem& problem() const { return problem_; }
  [[nodiscard]] const NewtonSystem& system() const { return system_; }
  [[nodiscard]] const Eigen::VectorXd& y() const { return y_; }

  [[nodiscard]] PolishReport solve();
  [[nodiscard]] Curvature lowest_curvature();

 private:
  struct Errors {
    double gradient = 0;    // |dL| / |dE|
    double constraint = 0;  // largest of all border equations, in units of R_c
    [[nodiscard]] bool are_small() const {
      return gradient < gradient_tolerance && constraint < constraint_tolerance;
    }
    [[nodiscard]] double size() const { return gradient + constraint; }
  };

  [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd& y) {
    return system_.residual(at_rest(), time_, y, rest_);
  }
  [[nodiscard]] double gradient_scale() const;
  [[nodiscard]] Errors errors(const Eigen::VectorXd& residual, double scale) const;
  [[nodiscard]] double allowed_fraction(const Eigen::VectorXd& change) const;

  problem::Scales scales_;
  double time_;
  problem::VariationalProblem problem_;
  NewtonSystem system_;
  Eigen::VectorXd y_;
  Eigen::VectorXd rest_;
};

/// |dE|, or its natural unit where that is more.
double Optimality::gradient_scale() const {
  Eigen::VectorXd without_multipliers = y_;
  without_multipliers.tail(problem_.num_multipliers()).setZero();
  const auto gradient = problem_.residual(at_rest(), time_, without_multipliers, rest_);
  return std::max(gradient.head(problem_.num_nodal()).norm(), scales_.energy / scales_.length);
}

Optimality::Errors Optimality::errors(const Eigen::VectorXd& residual, double scale) const {
  const double length = std::min(1.0, scales_.length);
  Errors result;
  result.gradient = residual.head(problem_.num_nodal()).norm() / scale;
  result.constraint = residual.tail(problem_.num_multipliers()).lpNorm<Eigen::Infinity>() /
                      (length * length * length);
  return result;
}

double Optimality::allowed_fraction(const Eigen::VectorXd& change) const {
  double largest = 0;
  for (Eigen::Index row = 3; row < problem_.num_nodal(); row += problem_.block_size())
    largest = std::max(largest, std::abs(change[row]));
  return std::min(1.0, largest_displacement * scales_.length / largest);
}

PolishReport Optimality::solve() {
  PolishReport report;
  Eigen::VectorXd now = residual(y_);
  double scale = gradient_scale();
  Errors error = errors(now, scale);
  while (!error.are_small() && report.iterations < max_iterations) {
    ++report.iterations;
    system_.set_up(at_rest(), {1, 0}, time_, y_, rest_);
    const Eigen::VectorXd change = system_.solve_accurately(now);
    double fraction = allowed_fraction(change);
    bool is_better = false;
    for (int halving = 0; halving < max_halvings && !is_better; ++halving, fraction /= 2) {
      const Eigen::VectorXd trial = y_ - fraction * change;
      const Eigen::VectorXd there = residual(trial);
      const Errors trial_error = errors(there, scale);
      is_better = trial_error.size() < error.size();
      if (!is_better) continue;
      y_ = trial;
      now = there;
      error = trial_error;
    }
    if (!is_better) break;
    scale = gradient_scale();
  }
  report.gradient = error.gradient;
  report.is_converged = error.gradient < 1e-8 && error.constraint < 1e-9;
  return report;
}

/// Lanczos' method for z -> (H + s M)^-1 M z on the tangent space of constraints and gauge, in the
/// inner product of M, which acts on displacements and order parameter only. Its extreme
/// eigenvalues are 1 / (theta + s), and both ends matter: theta < -s shows as a negative one.
Curvature Optimality::lowest_curvature() {
  const double s = shift / scales_.time();
  linalg::BorderedMatrix matrix = problem_.make_matrix();
  const Eigen::VectorXd mask = problem_.differential_mask();
  problem_.jacobian(at_rest(), {0, 1}, time_, y_, rest_, matrix);
  system_.set_up(at_rest(), {1, s}, time_, y_, rest_);
  const auto metric = [&](const Eigen::VectorXd& z) -> Eigen::VectorXd {
    return matrix.multiply(z.cwiseProduct(mask)).cwiseProduct(mask);
  };
  Lanczos lanczos([&](const Eigen::VectorXd& z) { return system_.solve(metric(z)); }, metric,
                  y_.size(), krylov_dimension);
  Curvature result;
  for (;;) {
    const auto size = lanczos.dimension();
    const auto eigen = lanczos.projected();
    const Eigen::Index which = eigen.values[0] < 0 ? 0 : size - 1;
    const double last = result.value;
    result.value = 1 / eigen.values[which] - s;
    const bool is_settled =
        size > min_krylov_dimension && std::abs(result.value - last) <= eigenvalue_tolerance * s;
    if (is_settled || size == krylov_dimension) {
      result.mode = problem_.displacements(lanczos.vector(eigen.vectors.col(which)));
      result.mode /=
          std::max(result.mode.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
      return result;
    }
    lanczos.extend(size + 1);
  }
}

}  // namespace

Equilibrium find_equilibrium(const SolverOptions& options, const model::Model& model,
                             const problem::State& state, const mesh::Positions& reference) {
  Optimality optimality(checked("solver", options), model, state, reference);
  Equilibrium result;
  result.report = optimality.solve();
  result.report.curvature = optimality.lowest_curvature();
  const auto& y = optimality.y();
  result.state.time = state.time;
  result.state.triangulation = state.triangulation;
  result.state.values = optimality.problem().values(state.time, y);
  result.state.rates = optimality.problem().rates(y, Eigen::VectorXd::Zero(y.size()));
  result.energy = *optimality.problem().energy(state.time, y);
  result.counts = optimality.system().counts();
  result.counts.newton = result.report.iterations;
  result.seconds = optimality.system().seconds();
  return result;
}

std::string no_equilibrium_text(const PolishReport& report) {
  return fmt::format("polish: no equilibrium after {} steps, relative gradient {:.1e}",
                     report.iterations, report.gradient);
}

Curvature lowest_curvature(const SolverOptions& options, const model::Model& model,
                           const problem::State& state) {
  return Optimality(checked("solver", options), model, state, state.values.positions)
      .lowest_curvature();
}

}  // namespace vesica::solve
