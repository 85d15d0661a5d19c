#include "target_approach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "energy_metric.hpp"
#include "energy_sample.hpp"
#include "mesh_care.hpp"
#include "minimiser_coordinates.hpp"
#include "problem/zero_fields.hpp"
#include "vesica/core/error.hpp"
#include "vesica/linalg/dense.hpp"
#include "vesica/problem/normal_graph.hpp"
#include "vesica/problem/scales.hpp"

namespace vesica::minimise {
namespace {

constexpr int max_stages = 300;
constexpr int stages_between_looks = 20;  // by then the error must have become smaller
constexpr double met = 1e-6;              // relative
constexpr double largest_move = 0.1;      // of a node in a stage, in R_c
constexpr double largest_change = 0.3;    // of the order parameter in a stage
constexpr double perturbation = 0.03;     // of a sphere, in R_c
constexpr double independence = 1e-6;     // of directions that are nearly the same
constexpr int max_halvings = 5;           // of a stage that folds the surface

/// Equations, metric and coordinates on the surface of one stage.
class Stage {
 public:
  Stage(const model::Model& model, const problem::Scales& scales, const problem::State& state,
        int threads)
      : problem_(state.triangulation, model, threads),
        constraints_(model, scales),
        metric_(problem_, scales),
        state_(state),
        graph_(problem::make_normal_graph(*state.triangulation, state.values.positions)) {
    metric_.factorise(state.values.positions, state.values.order_parameter);
    coordinates_.emplace(metric_, graph_);
  }

  /// The shortest change of (d, c) that meets the linearised constraints.
  [[nodiscard]] Eigen::VectorXd change() const {
    const auto now = problem_.constraints(state_.values.positions, state_.values.order_parameter);
    const auto gradients = constraints_.gradients(graph_, now, state_.is_two_phase());
    Eigen::MatrixXd slopes(metric_.size(), constraints_.size());
    for (Eigen::Index k = 0; k < constraints_.size(); ++k)
      slopes.col(k) = coordinates_->slope(gradients.col(k));
    const Eigen::VectorXd units = slopes.colwise().norm().cwiseMax(1e-300);
    const auto system = linalg::singular_system(slopes * units.cwiseInverse().asDiagonal());
    const Eigen::VectorXd errors = constraints_.errors(now).cwiseQuotient(units);
    const Eigen::VectorXd z =
        system.left * (system.right.transpose() * errors)
                          .cwiseQuotient(system.values.cwiseMax(independence * system.values[0]));
    return -coordinates_->spread(z);
  }

  /// A random normal displacement; c stays.
  [[nodiscard]] Eigen::VectorXd random_change() const {
    std::mt19937 engine(1);
    std::normal_distribution<double> normal;
    const Eigen::VectorXd z =
        Eigen::VectorXd::NullaryExpr(metric_.size(), [&] { return normal(engine); });
    Eigen::VectorXd change = coordinates_->spread(coordinates_->without_rigid(z));
    change.tail(change.size() - num_nodes()).setZero();
    return change / change.cwiseAbs().maxCoeff();
  }

  [[nodiscard]] double move_of(const Eigen::VectorXd& change) const {
    return change.head(num_nodes()).cwiseAbs().maxCoeff();
  }
  [[nodiscard]] double phase_change_of(const Eigen::VectorXd& change) const {
    return change.size() > num_nodes() ? change.tail(num_nodes()).cwiseAbs().maxCoeff() : 0;
  }
  [[nodiscard]] problem::Fields moved(const Eigen::VectorXd& change) const {
    problem::Fields fields = state_.values;
    fields.positions = positions_of(graph_, change);
    if (state_.is_two_phase()) fields.order_parameter += change.tail(num_nodes());
    return fields;
  }

 private:
  [[nodiscard]] Eigen::Index num_nodes() const { return state_.values.positions.rows(); }

  problem::EnergyProblem problem_;
  ConstraintSet constraints_;
  EnergyMetric metric_;
  const problem::State& state_;
  problem::NormalGraph graph_;
  std::optional<MinimiserCoordinates> coordinates_;
};

/// Takes the change, or the half of it and so on, that leaves the mesh whole.
void take(problem::State& state, const Stage& stage, Eigen::VectorXd change, MeshCare& care) {
  for (int halving = 0;; ++halving, change /= 2) {
    problem::Fields next = stage.moved(change);
    const auto condition = mesh_condition({state.triangulation, next.positions});
    if (care.is_degenerate(condition)) {
      if (halving < max_halvings) continue;
      throw SolverError(
          fmt::format("on the way to the targets the mesh degenerates ({}); start from a shape "
                      "that is nearer, or refine it",
                      describe(condition)));
    }
    state.values = std::move(next);
    if (!care.is_worn(condition)) return;
    auto even = care.redistribute(state.surface(), state.values.order_parameter);
    state.values.positions = std::move(even.positions);
    state.values.order_parameter = std::move(even.order_parameter);
    return;
  }
}

}  // namespace

double scale_to_targets(const model::Model& model, problem::State& state) {
  const auto evaluation = problem::EnergyProblem(state.triangulation, model, 0)
                              .constraints(state.values.positions, state.values.order_parameter);
  const auto ratio = [&]<class Constraint>(const Constraint&) {
    const auto& target = model.targets.of<Constraint>();
    const double value = evaluation.values[model::place_of<model::Constraints, Constraint>];
    return target ? target->first() / value : 0;
  };
  const double areas = ratio(model::Area{});
  const double volumes = ratio(model::Volume{});
  const double factor = areas > 0 ? std::sqrt(areas) : volumes > 0 ? std::cbrt(volumes) : 1;
  const Eigen::RowVector3d centre = state.values.positions.colwise().mean();
  state.values.positions =
      ((state.values.positions.rowwise() - centre) * factor).rowwise() + centre;
  return factor;
}

double largest_target_error(const model::Model& model, const problem::State& start) {
  const ConstraintSet constraints(model, problem::scales_of(model, start));
  if (constraints.size() == 0) return 0;
  return constraints.largest_error(
      problem::EnergyProblem(start.triangulation, model, 0)
          .constraints(start.values.positions, start.values.order_parameter));
}

Approach approach_targets(const model::Model& model, problem::State start,
                          const ApproachOptions& options) {
  Approach result;
  const problem::Scales scales = problem::scales_of(model, start);
  MeshCare care(start.surface(), even_mesh);
  if (options.is_symmetric) {
    const Stage stage(model, scales, start, options.threads);
    take(start, stage, perturbation * scales.length * stage.random_change(), care);
  }
  double looked_at = std::numeric_limits<double>::infinity();
  for (;; ++result.stages) {
    result.error = largest_target_error(model, start);
    result.is_done = result.error < met;
    if (result.is_done || result.stages == max_stages) break;
    if (options.may_go_on && !options.may_go_on()) break;
    if (result.stages % stages_between_looks == 0) {
      if (result.error > 0.9 * looked_at) break;
      looked_at = result.error;
    }
    const Stage stage(model, scales, start, options.threads);
    const Eigen::VectorXd change = stage.change();
    const double fraction =
        std::min({1.0, largest_move * scales.length / stage.move_of(change),
                  largest_change / std::max(stage.phase_change_of(change), 1e-300)});
    take(start, stage, fraction * change, care);
  }
  start.rates = problem::zero_fields(start.values.positions.rows(), start.is_two_phase());
  start.values.mean_curvature = start.rates.mean_curvature;
  result.state = std::move(start);
  return result;
}

}  // namespace vesica::minimise
