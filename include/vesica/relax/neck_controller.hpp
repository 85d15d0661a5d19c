#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "vesica/measure/neck.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Ends a run in which a neck closes: the surface is about to change its topology, which no step
/// can follow. With the length w = interface width, 0.2 R_c for a single phase, and the radius r =
/// length / 2 pi of the shortest neck (measure::find_neck):
///
///     r < 0.15 w, or
///     r < 0.25 w when a step fails, a limit is hit, or after 100 steps in a row,
///
/// as long as the neck shrinks, so r is smaller than it was up to four steps before, and the
/// vesicle moves, with a normal velocity without rigid motion above 0.03 (natural units): a thin
/// neck at rest is an equilibrium. The status is RunStatus::budding where the smaller side is of
/// one phase (95 % of its area) which is also on the larger side (5 % of its area), so that it
/// becomes a domain of its own, and RunStatus::neck_closes elsewhere.
class NeckController final : public Controller {
 public:
  /// Makes the controller. The `scales` of the case give R_c and the unit of the velocity.
  NeckController(const model::Model& model, const problem::Scales& scales);
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_limit(const StepView& view) override;

 private:
  void look(const StepView& view);
  /// Tells whether the neck that was last found is thinner than `radius` and shrinks, and the
  /// vesicle moves.
  [[nodiscard]] bool closes(const StepView& view, double radius) const;
  [[nodiscard]] std::vector<Request> stop_if_closing(const StepView& view) const;
  [[nodiscard]] Stop stop(const StepView& view) const;

  [[nodiscard]] double width(const StepView& view) const { return width_.value(view.state.time); }

  model::Schedule width_;
  problem::Scales scales_;
  std::optional<measure::Neck> neck_;
  std::deque<double> radii_;  // of the last steps with a neck, the last one included
  int thin_steps_ = 0;        // in a row
};

}  // namespace vesica::relax
