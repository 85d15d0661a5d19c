#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/solve/solver_options.hpp"

namespace vesica::relax {

/// The verdict on a run, the content of `verdict.json`.
struct Verdict {
  /// The random number that the files of a run share; absent in files of older versions.
  std::optional<std::string> run;
  std::vector<std::string> warnings;  ///< about the case, one sentence each
  relax::Outcome outcome;
  std::string method;  ///< name of the integrator, as in the case file
  /// Equations whose equilibrium the run looked for: the weak form ("paper") or the discrete energy
  /// ("variational").
  std::string scheme;
  double time = 0;  ///< [time]
  model::PerConstraint multipliers;
  measure::VelocityNorms velocity;  ///< over R_c [length/time]
  measure::ShapeNumbers shape;
  double area_ratio = 0;
  double smallest_normal_cosine = 0;
  std::int32_t num_nodes = 0;
  std::int32_t num_triangles = 0;

  /// Visits the values in the layout of `verdict.json`.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    auto& outcome = self.outcome;
    visit(Field{"status", "-", "how the run ended"}, outcome.status);
    visit(Field{"reason", "-", "one sentence"}, outcome.reason);
    visit(Field{"time", "time", "time reached"}, self.time);
    visit(Field{"method", "-", "as in the case file"}, self.method);
    visit(Field{"scheme", "-", "paper or variational"}, self.scheme);
    visit(Field{"multipliers", "-", "signs as in (1.7a)"}, self.multipliers);
    visit(Field{"mesh/nodes", "-", "nodes"}, self.num_nodes);
    visit(Field{"mesh/triangles", "-", "triangles"}, self.num_triangles);
    visit(Field{"", "-", "measured at the end"}, outcome.diagnostics);
    visit(Field{"", "length/time", "velocities over R_c"}, self.velocity);
    visit(Field{"mesh/quality_initial", "-", "at the start"}, outcome.initial_quality);
    visit(Field{"mesh/quality_smallest", "-", "over the run"}, outcome.smallest_quality);
    visit(Field{"mesh/area_ratio", "-", "largest element over smallest"}, self.area_ratio);
    visit(Field{"mesh/smallest_normal_cosine", "-",
                "between neighbouring flat triangles; -1 for a fold"},
          self.smallest_normal_cosine);
    visit(Field{"mesh/adaptions", "-", "of a fixed mesh, always 0"}, 0);
    visit(Field{"mesh/remeshings", "-", "number of changes of the mesh"}, outcome.mesh_changes);
    visit(Field{"", "-", "numbers of the shape"}, self.shape);
    visit(Field{"events", "-", "in the order in which they were noticed"}, outcome.events);
    visit(Field{"", "-", "work"}, outcome.report);
    visit(Field{"warnings", "-", "about the case, one sentence each"}, self.warnings);
    visit(Field{"run", "-", "the number that the files of a run share"}, self.run);
  }
};

/// Makes the verdict on a run that ended with `outcome` in `state`, the last good one.
[[nodiscard]] Verdict make_verdict(relax::Outcome outcome, const solve::SolverOptions& solver,
                                   const model::Model& model, const problem::State& state);

/// Returns the exit status of the program: 0 converged, 1 stopped before convergence, 3 numerical
/// failure, 128 + signal interrupted (130 SIGINT, 143 SIGTERM).
[[nodiscard]] int exit_status(const relax::Outcome& outcome);

}  // namespace vesica::relax
