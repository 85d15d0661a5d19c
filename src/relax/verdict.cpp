#include "vesica/relax/verdict.hpp"

#include <csignal>
#include <utility>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::relax {

Verdict make_verdict(relax::Outcome outcome, const solve::SolverOptions& solver,
                     const model::Model& model, const problem::State& state) {
  Verdict verdict;
  verdict.outcome = std::move(outcome);
  verdict.method = name_of(solver.method);
  const bool minimises = solver.method == solve::Method::minimize;
  verdict.scheme = name_of(minimises ? solve::Scheme::variational : solver.scheme);
  verdict.time = state.time;
  verdict.multipliers = state.values.multipliers;
  verdict.shape = measure::shape_numbers(model, state);
  verdict.velocity = verdict.outcome.diagnostics.velocity.over(verdict.shape.characteristic_radius);
  const auto& positions = state.values.positions;
  verdict.area_ratio = mesh::area_ratio(*state.triangulation, positions);
  verdict.smallest_normal_cosine = mesh::smallest_normal_cosine(*state.triangulation, positions);
  verdict.num_nodes = state.triangulation->num_nodes();
  verdict.num_triangles = state.triangulation->num_triangles();
  return verdict;
}

int exit_status(const relax::Outcome& outcome) {
  switch (outcome.status) {
    case relax::RunStatus::converged:
      return 0;
    case relax::RunStatus::end_time:
    case relax::RunStatus::time_limit:
    case relax::RunStatus::step_limit:
    case relax::RunStatus::stopped:
    case relax::RunStatus::neck_closes:
    case relax::RunStatus::budding:
    case relax::RunStatus::self_intersection:
    case relax::RunStatus::unresolved:
      return 1;
    case relax::RunStatus::interrupted:
      return 128 + (outcome.signal == 0 ? SIGINT : outcome.signal);
    case relax::RunStatus::numerical_failure:
      break;
  }
  return 3;
}

}  // namespace vesica::relax
