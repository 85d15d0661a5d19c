#pragma once

#include <array>
#include <string>
#include <vector>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::relax {

/// State, report and measured values that observers and controllers see after an accepted step (and
/// once before the first: step 0).
struct StepView {
  const problem::State& state;
  const solve::StepReport& report;
  const measure::Diagnostics& diagnostics;
};

/// An event that is worth a line in the log: a change of the mesh or of the number of phase
/// domains.
struct Event {
  long step = 0;
  double time = 0;  ///< [time]
  std::string what;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"step", "-", "step in which it was noticed"}, self.step);
    visit(Field{"time", "time", "time of that step"}, self.time);
    visit(Field{"what", "-", "one line"}, self.what);
  }
};

/// A change of the mesh between two steps.
struct MeshChange {
  long step = 0;
  double time = 0;  ///< [time]
  mesh::NodeIndex nodes_before = 0;
  mesh::NodeIndex nodes_after = 0;
  double quality_before = 0;
  double quality_after = 0;
  std::string reason;  ///< what follows "because"

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"step", "-", "step after which it was made"}, self.step);
    visit(Field{"time", "time", "time of that step"}, self.time);
    visit(Field{"nodes_before", "-", "nodes of the old mesh"}, self.nodes_before);
    visit(Field{"nodes_after", "-", "nodes of the new mesh"}, self.nodes_after);
    visit(Field{"quality_before", "-", "quality (3.5) of the old mesh"}, self.quality_before);
    visit(Field{"quality_after", "-", "quality (3.5) of the new mesh"}, self.quality_after);
    visit(Field{"reason", "-", "what follows \"because\""}, self.reason);
  }
};

/// Reason why a run ended. The numbers are not the exit status; `exit_status` in relax/verdict.hpp
/// maps them.
enum class RunStatus {
  converged,
  end_time,
  step_limit,
  time_limit,
  stopped,
  neck_closes,
  budding,
  self_intersection,
  unresolved,
  interrupted,
  numerical_failure
};

}  // namespace vesica::relax

namespace vesica {

/// Names of `verdict.json`. Two limits of time are one for its readers, the first one listed.
template <>
struct EnumNames<relax::RunStatus> {
  using enum relax::RunStatus;
  static constexpr std::array<std::pair<relax::RunStatus, std::string_view>, 11> names{
      {{converged, "converged"},
       {time_limit, "time limit"},
       {end_time, "time limit"},
       {step_limit, "step limit"},
       {stopped, "stopped"},
       {neck_closes, "neck closes"},
       {budding, "budding"},
       {self_intersection, "self-intersection"},
       {unresolved, "unresolved"},
       {interrupted, "interrupted"},
       {numerical_failure, "numerical failure"}}};
};

}  // namespace vesica

namespace vesica::relax {

/// Result of relax(): how it ended, and the numbers of the last good state.
struct Outcome {
  RunStatus status = RunStatus::converged;
  std::string reason;  ///< one sentence
  int signal = 0;      ///< the signal that interrupted the run, 0 for none
  measure::Diagnostics diagnostics;
  solve::StepReport report;
  double smallest_quality = 0;  ///< smallest mesh quality over the run
  double initial_quality = 0;
  std::vector<MeshChange> mesh_changes;
  std::vector<Event> events;  ///< in the order in which they were noticed
};

/// Watches a run; changes nothing. Derive from it to record or draw.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// Is called after every accepted step; step 0 is the start.
  virtual void observe(const StepView& view) = 0;
  /// Is called after a change of the mesh, with the state on the new one.
  virtual void mesh_changed(const StepView& view, const MeshChange& change) {
    (void)view;
    (void)change;
  }
  /// Is called as soon as an event is noticed; for a change of the mesh after `mesh_changed`.
  virtual void happened(const StepView& view, const Event& event) {
    (void)view;
    (void)event;
  }
  /// Is called once, after the last step, with the final state; also after a failure.
  virtual void finish(const StepView& view, const Outcome& outcome) {
    (void)view;
    (void)outcome;
  }
};

}  // namespace vesica::relax
