#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/solve/solver_options.hpp"

namespace vesica::relax {

/// What a run ended with: the content of `verdict.json`.
struct Verdict {
  relax::Outcome outcome;
  std::string method;  ///< name of the integrator, as in the case file
  /// Whose equilibrium the run looked for: that of the weak form ("paper") or of the discrete
  /// energy
  /// ("variational").
  std::string scheme;
  double time = 0;  ///< [time]
  model::PerConstraint multipliers;
  measure::ShapeNumbers shape;
  double area_ratio = 0;              ///< largest element area over the smallest
  double smallest_normal_cosine = 0;  ///< between neighbouring flat triangles; -1 for a fold
  std::int32_t num_nodes = 0;
  std::int32_t num_triangles = 0;
};

/// The verdict on `state`, the last good one.
[[nodiscard]] Verdict make_verdict(relax::Outcome outcome, const solve::SolverOptions& solver,
                                   const model::Model& model, const problem::State& state);

/// "converged", "time limit", "step limit", "neck closes", "budding", "self-intersection",
/// "interrupted", "numerical failure"; "stopped" when a controller of the user ended the run.
[[nodiscard]] std::string_view status_name(relax::RunStatus status);

/// Exit status of the program: 0 converged, 1 stopped before convergence, 3 numerical failure, 128
/// + signal interrupted (130 SIGINT, 143 SIGTERM).
[[nodiscard]] int exit_status(const relax::Outcome& outcome);

}  // namespace vesica::relax
