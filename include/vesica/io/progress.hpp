#pragma once

#include <iosfwd>
#include <string>

#include "vesica/relax/observer.hpp"

namespace vesica::io {

/// How progress is told. rewriting: one line that is written anew after every step (terminals);
/// sparse: a line for the first step, then about every ten steps or five seconds, and the last
/// (pipes, files); none: silence.
enum class ProgressStyle { rewriting, sparse, none };

/// An observer that tells on a console how a run goes.
class Progress final : public relax::Observer {
 public:
  /// Makes the observer; `out` must outlive it.
  Progress(std::ostream& out, ProgressStyle style) : out_(out), style_(style) {}
  void observe(const relax::StepView& view) override;
  void happened(const relax::StepView& view, const relax::Event& event) override;
  void finish(const relax::StepView& view, const relax::Outcome& outcome) override;

 private:
  [[nodiscard]] bool is_due(const relax::StepView& view) const;
  void write(const relax::StepView& view);

  std::ostream& out_;
  ProgressStyle style_;
  bool is_first_ = true;
  long last_step_ = 0;
  double last_seconds_ = 0;
};

/// Returns the line of a step. Of a flow it has time, step size, order of the method, energy,
/// normal velocity over R_c (rigid motion removed), largest relative constraint error and mesh
/// quality:
///
///     step 37  t 0.1234  dt 1.2e-02  order 2  F 58.848702  v 1.2e-03  C 1.0e-09  q 0.512
///
/// Of a minimisation it has the distance to the minimum of `StepReport` after the energy:
///
///     step 5  evaluations 43  F 58.854221  distance 2.3e-07  C 2.4e-15  q 0.564
[[nodiscard]] std::string progress_line(const relax::StepView& view);

/// Returns the line of an event, as in `step 37 t 0.1234 domains of phase 1: 2 -> 1`.
[[nodiscard]] std::string event_line(const relax::Event& event);

}  // namespace vesica::io
