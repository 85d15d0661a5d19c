#include "vesica/relax/self_intersection_controller.hpp"

#include <fmt/format.h>

#include <string>

#include "vesica/measure/self_intersection.hpp"

namespace vesica::relax {

std::vector<Request> SelfIntersectionController::respond(const StepView& view) {
  if (view.report.counts.steps % every_steps_ != 0) return {};
  return look(view);
}

std::vector<Request> SelfIntersectionController::respond_to_rest(const StepView& view) {
  return look(view);
}

std::vector<Request> SelfIntersectionController::respond_to_limit(const StepView& view) {
  return look(view);
}

std::vector<Request> SelfIntersectionController::look(const StepView& view) {
  const auto first = measure::self_intersections(view.state.surface(), 1);
  if (first.empty()) {
    last_free_step_ = view.report.counts.steps;
    return {};
  }
  const Eigen::Vector3d& x = first.front().point;
  const auto [a, b] = first.front().triangles;
  const std::string before = last_free_step_
                                 ? fmt::format("free of it after step {}", *last_free_step_)
                                 : "as at the start";
  return {Stop{RunStatus::self_intersection,
               fmt::format("the surface cuts itself after step {}, triangles {} and {} at ({:.4g}, "
                           "{:.4g}, {:.4g}); {}",
                           view.report.counts.steps, a, b, x.x(), x.y(), x.z(), before)}};
}

}  // namespace vesica::relax
