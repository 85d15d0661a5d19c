#include "vesica/relax/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "vesica/adapt/local_remesh.hpp"
#include "vesica/adapt/transfer.hpp"
#include "vesica/fem/node_graph.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/model/two_phase.hpp"
#include "vesica/paper/bisection.hpp"
#include "vesica/paper/conformal_remesh.hpp"

namespace vesica::relax {
namespace {

constexpr double smallest_quality = 0.1;        // of a new mesh, 0.5 as a rule
constexpr double smallest_normal_cosine = 0.0;  // of a new mesh: neighbours form no fold
constexpr double quality_kept = 0.7;            // where the constraints are restored
constexpr double coarsest_angle = 0.5;          // where nodes are short; edge times curvature
constexpr double coarsest_interface = 0.5;      // and edge over interface width
constexpr int halvings = 6;
constexpr int max_attempts = 4;    // to stay within max_nodes
constexpr double surplus = 1.005;  // of the edges, in another attempt

double quality_of(const mesh::Surface& surface) {
  return mesh::quality(*surface.triangulation, surface.positions);
}

bool is_usable(const mesh::Surface& surface) {
  return quality_of(surface) > smallest_quality &&
         mesh::smallest_normal_cosine(*surface.triangulation, surface.positions) >
             smallest_normal_cosine;
}

/// Nodal fields at the new nodes; multipliers as they are.
problem::Fields carried_over(const mesh::Triangulation& old,
                             const std::vector<mesh::SurfaceLocation>& origins,
                             const problem::Fields& fields) {
  problem::Fields result;
  result.positions = mesh::interpolate(old, origins, fields.positions);
  result.mean_curvature = mesh::interpolate(old, origins, fields.mean_curvature);
  if (fields.order_parameter.size() > 0)
    result.order_parameter = mesh::interpolate(old, origins, fields.order_parameter);
  result.multipliers = fields.multipliers;
  return result;
}

/// Tells whether a new mesh gives a functional back: one that is constrained, or is unless the case
/// leaves it free.
template <class Constraint>
bool is_restored(const model::Model& model, const problem::State& state) {
  if (Constraint::needs_phase_field && !state.is_two_phase()) return false;
  return model.targets.of<Constraint>() || !requires { Constraint::default_target; };
}

/// The functionals that are restored.
Eigen::VectorXd integrals_of(const model::Model& model, const problem::State& state) {
  const auto measured = measure::measure({{}, state.is_two_phase(), {}}, state).measures;
  std::vector<double> present;
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    if (is_restored<Constraint>(model, state)) present.push_back(measured.values[place].value());
  });
  return Eigen::Map<const Eigen::VectorXd>(present.data(),
                                           static_cast<Eigen::Index>(present.size()));
}

/// Directions in which the functionals are restored: along the normals by the variation of each, or
/// in c by that of the ones that depend on it.
std::vector<adapt::NodalChange> restoring_changes(const model::Model& model,
                                                  const problem::State& state) {
  const Eigen::Index n = state.values.positions.rows();
  std::vector<adapt::NodalChange> changes;
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t) {
    if (!is_restored<Constraint>(model, state)) return;
    Eigen::VectorXd change(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      model::SurfacePoint<double> point{};
      point.mean_curvature = state.values.mean_curvature[i];
      point.order_parameter = state.is_two_phase() ? state.values.order_parameter[i] : 1;
      const auto v = model::variation_of_term<Constraint>({}, point);
      change[i] = Constraint::needs_phase_field ? v.s : v.a;
    }
    changes.push_back(Constraint::needs_phase_field ? adapt::NodalChange{{}, change}
                                                    : adapt::NodalChange{change, {}});
  });
  return changes;
}

/// Takes the constrained functionals back to what they were, unless the mesh would suffer: a stepper
/// meets its constraints anyway.
void restore(const model::Model& model, problem::State& state, const Eigen::VectorXd& targets) {
  const auto directions =
      adapt::restoring_directions(state.surface(), restoring_changes(model, state));
  problem::State trial = state;
  const auto integrals = [&](const adapt::RestorableFields& fields) {
    trial.values.positions = fields.positions;
    trial.values.order_parameter = fields.order_parameter;
    return integrals_of(model, trial);
  };
  auto restored = adapt::restore_integrals(integrals, targets, directions,
                                           {state.values.positions, state.values.order_parameter});
  const mesh::Surface surface{state.triangulation, restored.fields.positions};
  if (quality_of(surface) < quality_kept * quality_of(state.surface()) || !is_usable(surface))
    return;
  state.values.positions = std::move(restored.fields.positions);
  state.values.order_parameter = std::move(restored.fields.order_parameter);
}

/// What the size of elements depends on.
fem::NodalShapeOperator shape_operator_of(const problem::State& state,
                                          const fem::NodeGraph& graph) {
  return fem::recover_shape_operator(*state.triangulation, graph, state.values.positions, 0);
}

fem::NodalShapeOperator shape_operator_of(const problem::State& state) {
  return shape_operator_of(state, fem::NodeGraph(*state.triangulation));
}

adapt::PhaseInterface phases_of(const model::Model& model, const problem::State& state) {
  return {state.values.order_parameter, model.material.interface_width.value(state.time)};
}

/// Makes the new mesh of a plan; absent when there is none that differs.
struct Mesher {
  const model::Model& model;
  const problem::State& state;
  double max_nodes;

  std::optional<adapt::Remeshed> operator()(const adapt::SizeFieldOptions& sizes) const {
    const mesh::Surface old = state.surface();
    Eigen::VectorXd edges = wanted_sizes(model, state, sizes, max_nodes);
    adapt::Remeshed changed = adapt::local_remesh(old, edges);
    for (int attempt = 1; attempt < max_attempts; ++attempt) {
      const double excess = changed.surface.triangulation->num_nodes() / max_nodes;
      if (excess <= 1) break;
      edges *= surplus * std::sqrt(excess);
      changed = adapt::local_remesh(old, edges);
    }
    return changed;
  }
  std::optional<adapt::Remeshed> operator()(const BisectionPlan& plan) const {
    paper::Bisected bisected =
        paper::bisect(state.surface(), wanted_marks(model, state, plan.marking, max_nodes));
    if (!bisected.is_changed()) return std::nullopt;
    return std::move(bisected.mesh);
  }
  std::optional<adapt::Remeshed> operator()(const ConformalPlan& plan) const {
    auto image =
        paper::conformal_remesh(state.surface(), shape_operator_of(state), phases_of(model, state),
                                plan.otherwise.marking, max_nodes);
    if (image && is_usable(image->surface) &&
        quality_of(image->surface) > quality_of(state.surface())) {
      return image;
    }
    return (*this)(plan.otherwise);
  }
};

/// For the first bisection the state with its triangles turned; corners have no meaning otherwise.
problem::State prepared(const problem::State& state, const MeshPlan& plan) {
  problem::State result = state;
  const auto* conformal = std::get_if<ConformalPlan>(&plan);
  const auto* bisection =
      conformal != nullptr ? &conformal->otherwise : std::get_if<BisectionPlan>(&plan);
  if (bisection != nullptr && bisection->is_first)
    result.triangulation = paper::with_longest_sides_first(state.surface()).triangulation;
  return result;
}

/// Curvature angle and interface size times `growth`, but not beyond the coarsest.
adapt::SizeFieldOptions grown(const adapt::SizeFieldOptions& options, double growth) {
  const auto up_to = [growth](double value, double coarsest) {
    return std::max(value, std::min(growth * value, coarsest));
  };
  adapt::SizeFieldOptions result = options;
  result.curvature_angle = up_to(options.curvature_angle, coarsest_angle);
  result.interface_size = up_to(options.interface_size, coarsest_interface);
  return result;
}

/// The sizes with the least growth that are within the limit; those of the largest when none are.
template <class Sizes, class Limit>
Eigen::VectorXd finest(const Sizes& sizes_of, const Limit& is_within, double largest_growth) {
  Eigen::VectorXd sizes = sizes_of(1);
  if (is_within(sizes) || largest_growth <= 1) return sizes;
  double low = 1;
  double high = largest_growth;
  sizes = sizes_of(high);
  for (int halving = 0; halving < halvings && is_within(sizes); ++halving) {
    const double middle = (low + high) / 2;
    Eigen::VectorXd finer = sizes_of(middle);
    if (is_within(finer)) {
      sizes = std::move(finer);
      high = middle;
    } else {
      low = middle;
    }
  }
  return sizes;
}

}  // namespace

Eigen::VectorXd wanted_sizes(const model::Model& model, const problem::State& state,
                             const adapt::SizeFieldOptions& options, double max_nodes) {
  const mesh::Surface surface = state.surface();
  const fem::NodeGraph graph(*state.triangulation);
  const auto shape_operator = shape_operator_of(state, graph);
  const adapt::PhaseInterface phases = phases_of(model, state);
  const auto sizes_of = [&](double growth) {
    return adapt::size_field(surface, graph, shape_operator, phases, grown(options, growth));
  };
  const auto is_within = [&](const Eigen::VectorXd& sizes) {
    return adapt::wanted_nodes(surface, sizes) <= max_nodes;
  };
  const double largest_growth = std::max(coarsest_angle / options.curvature_angle,
                                         coarsest_interface / options.interface_size);
  return adapt::limited_sizes(surface, finest(sizes_of, is_within, largest_growth), max_nodes);
}

std::vector<paper::Mark> wanted_marks(const model::Model& model, const problem::State& state,
                                      const paper::BisectionOptions& marking, double max_nodes) {
  const mesh::Surface surface = state.surface();
  return paper::marks(
      surface,
      paper::wanted_diameters(surface, shape_operator_of(state), phases_of(model, state), marking),
      max_nodes);
}

std::optional<problem::State> remeshed(const model::Model& model, const problem::State& state,
                                       const Remesh& remesh) {
  const problem::State old = prepared(state, remesh.plan);
  const auto changed = std::visit(Mesher{model, old, remesh.max_nodes}, remesh.plan);
  if (!changed || !is_usable(changed->surface)) return std::nullopt;
  problem::State result;
  result.time = old.time;
  result.damping = old.damping;
  result.triangulation = changed->surface.triangulation;
  result.values = carried_over(*old.triangulation, changed->origins, old.values);
  result.rates = carried_over(*old.triangulation, changed->origins, old.rates);
  restore(model, result, integrals_of(model, old));
  return result;
}

}  // namespace vesica::relax
