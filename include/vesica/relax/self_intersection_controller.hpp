#pragma once

#include <optional>
#include <vector>

#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Ends a run in which the surface cuts itself (RunStatus::self_intersection), which no energy of
/// the model forbids. Looks every `every_steps` steps, the start included, and before the run ends
/// in an equilibrium or at a limit (measure::self_intersections).
class SelfIntersectionController final : public Controller {
 public:
  /// Makes the controller. With the `every_steps` of the frames, the last frame before the end
  /// shows no intersection.
  explicit SelfIntersectionController(long every_steps) : every_steps_(every_steps) {}
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_rest(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_limit(const StepView& view) override;

 private:
  [[nodiscard]] std::vector<Request> look(const StepView& view);

  long every_steps_;
  std::optional<long> last_free_step_;
};

}  // namespace vesica::relax
