#include "vesica/relax/neck_controller.hpp"

#include <fmt/format.h>

#include <numbers>
#include <string>

namespace vesica::relax {
namespace {

constexpr double closed_radius = 0.15;  // of the width
constexpr double thin_radius = 0.25;
constexpr double looked_for_radius = 0.3;
constexpr double width_of_single_phase = 0.2;  // of R_c
constexpr std::size_t compared_steps = 5;
constexpr int max_thin_steps = 100;
constexpr double slow = 0.03;  // as for the mesh near the equilibrium
constexpr double one_phase = 0.95;

struct Closing {
  RunStatus status;
  std::string what;
};

/// Shares of phase 1 in the areas of the smaller and the larger side.
Eigen::Array2d shares_of_phase_1(const measure::Neck& neck, const problem::State& state) {
  const Eigen::VectorXd is_phase_1 =
      (state.values.order_parameter.array() > 0).matrix().cast<double>();
  const Eigen::Array2d areas(neck.smaller_area, neck.larger_area);
  return (neck.side_areas.transpose() * is_phase_1).array() / areas;
}

Closing closing(const measure::Neck& neck, const problem::State& state) {
  if (!neck.separates)
    return {RunStatus::neck_closes, "a neck closes that does not cut the surface in two"};
  if (!state.is_two_phase()) return {RunStatus::neck_closes, "a neck closes"};
  const Eigen::Array2d phase_1 = shares_of_phase_1(neck, state);
  const int phase = phase_1[0] > 0.5 ? 1 : 2;
  const Eigen::Array2d shares = phase == 1 ? phase_1 : 1 - phase_1;
  if (shares[0] < one_phase) return {RunStatus::neck_closes, "a neck closes"};
  if (shares[1] < 1 - one_phase)
    return {RunStatus::neck_closes, "the neck between the phases closes"};
  return {RunStatus::budding, fmt::format("a domain of phase {} buds, its neck closes", phase)};
}

}  // namespace

NeckController::NeckController(const model::Model& model, const problem::Scales& scales)
    : width_(model.is_two_phase ? model.material.interface_width
                                : model::Schedule(width_of_single_phase * scales.length)),
      scales_(scales) {}

std::vector<Request> NeckController::respond(const StepView& view) {
  look(view);
  thin_steps_ = closes(view, thin_radius * width(view)) ? thin_steps_ + 1 : 0;
  if (!closes(view, closed_radius * width(view)) && thin_steps_ < max_thin_steps) return {};
  return {stop(view)};
}

std::vector<Request> NeckController::respond_to_failure(const StepView& view) {
  return stop_if_closing(view);
}

std::vector<Request> NeckController::respond_to_limit(const StepView& view) {
  return stop_if_closing(view);
}

std::vector<Request> NeckController::stop_if_closing(const StepView& view) const {
  if (!closes(view, thin_radius * width(view))) return {};
  return {stop(view)};
}

void NeckController::look(const StepView& view) {
  neck_ = measure::find_neck(view.state.surface(),
                             2 * std::numbers::pi * looked_for_radius * width(view));
  if (!neck_) {
    radii_.clear();
    return;
  }
  radii_.push_back(neck_->radius());
  if (radii_.size() > compared_steps) radii_.pop_front();
}

bool NeckController::closes(const StepView& view, double radius) const {
  if (!neck_ || neck_->radius() >= radius) return false;
  return radii_.back() < radii_.front() &&
         view.diagnostics.velocity.normal_rigid_free > slow * scales_.velocity_norm();
}

Stop NeckController::stop(const StepView& view) const {
  const Eigen::Vector3d& x = neck_->centre;
  std::string sides;
  if (neck_->separates)
    sides = fmt::format(", areas {:.4g} and {:.4g} on its sides", neck_->smaller_area,
                        neck_->larger_area);
  const auto [status, what] = closing(*neck_, view.state);
  return {status,
          fmt::format("{}: length {:.3g} (radius {:.3g}, {:.2f} of the {}) at ({:.4g}, {:.4g}, "
                      "{:.4g}){}",
                      what, neck_->length, neck_->radius(), neck_->radius() / width(view),
                      view.state.is_two_phase() ? "interface width" : "length 0.2 R_c", x.x(),
                      x.y(), x.z(), sides)};
}

}  // namespace vesica::relax
