#include "compare/common_mesh.hpp"

#include "vesica/compare/on_mesh.hpp"
#include "vesica/core/error.hpp"
#include "vesica/solve/polish.hpp"

namespace vesica::compare {

namespace {

Equilibrium as_it_ended(const ComparedRun& run) {
  return {run.state, run.verdict.outcome.diagnostics.energy.total()};
}

/// A polished equilibrium of the discrete energy.
bool is_polished_minimum(const ComparedRun& run) {
  return run.verdict.scheme == name_of(solve::Scheme::variational) &&
         run.verdict.outcome.report.polish && run.verdict.outcome.report.polish->is_converged;
}

Equilibrium polished(const ComparedRun& run, const problem::State& state,
                     const mesh::Positions& reference) {
  const auto equilibrium = solve::find_equilibrium({}, run.model, state, reference);
  if (!equilibrium.report.is_converged)
    throw RecoverableError("Newton's method does not converge on the common mesh");
  return {equilibrium.state, equilibrium.energy.total()};
}

}  // namespace

EquilibriumPair on_common_mesh(const ComparedRun& first, const ComparedRun& second) {
  if (is_polished_minimum(first) && is_polished_minimum(second)) {
    try {
      const auto motion = shape_distance(first.state, second.state).motion;
      const auto moved = on_mesh_of(first.state, second.state, motion);
      const auto& reference = first.state.values.positions;
      return {polished(first, first.state, reference), polished(second, moved, reference), true};
    } catch (const RecoverableError&) {
      // the shapes are too far apart for one mesh: no equilibrium in common
    }
  }
  return {as_it_ended(first), as_it_ended(second), false};
}

}  // namespace vesica::compare
