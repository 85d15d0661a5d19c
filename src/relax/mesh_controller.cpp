#include "vesica/relax/mesh_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/refuse.hpp"
#include "vesica/adapt/size_field.hpp"
#include "vesica/core/check.hpp"
#include "vesica/relax/remesh.hpp"

namespace vesica::relax {
namespace {

// Measured over the cases of Section 4: fewest changes with which all of them come to rest.
constexpr double low_quality = 0.3;
constexpr double lost_quality = 0.75;
constexpr double long_edge = 1.9;
constexpr double emergency_edge = 2.2;
constexpr double emergency_edge_near_rest = 3;
constexpr double surplus_nodes = 0.55;
constexpr double slow = 0.03;  // velocities in natural units
constexpr double moving = 0.3;
constexpr int max_changes_after_failures = 5;

// Distances to the minimum of a minimiser, which has no velocity.
constexpr double near_minimum = 1e-2;
constexpr double far_from_minimum = 0.3;
constexpr double at_minimum = 1e-3;
constexpr long steps_of_minimiser = 2;

}  // namespace

void AdaptionOptions::check_together() const {
  for_each_unused(*this, method, [this]<class T>(const Field& field, const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      refuse(fmt::format("adaption.{}", field.name), value,
             fmt::format("means nothing with adaption.method = \"{}\"", name_of(method)));
    }
  });
}

MeshController::MeshController(const AdaptionOptions& options, model::Model model,
                               const problem::Scales& scales)
    : options_(checked("adaption", options)), model_(std::move(model)), scales_(scales) {}

std::vector<Request> MeshController::respond(const StepView& view) {
  if (!new_quality_) new_quality_ = view.diagnostics.quality;
  if (view.report.counts.steps == 0) return {};
  if (may_change(view) && is_moving(view)) is_final_ = false;
  const bool has_left = has_left_saddle(view);
  if (auto reason = misfit(view)) {
    if (has_left) is_final_ = false;
    return ask(view, std::move(*reason));
  }
  if (is_final_ || !may_change(view) || !is_slow(view)) return {};
  is_final_ = true;
  return ask(view, "the vesicle is near its equilibrium");
}

std::vector<Request> MeshController::respond_to_failure(const StepView& view) {
  if (changes_after_failures_ == max_changes_after_failures) return {};
  if (is_final_ && view.report.gradient && *view.report.gradient < at_minimum) return {};
  ++changes_after_failures_;
  return ask(view, "a step failed");
}

std::vector<Request> MeshController::respond_to_rest(const StepView& view) {
  if (is_final_) return {};
  is_final_ = true;
  return ask(view, "the vesicle is in equilibrium");
}

adapt::SizeFieldOptions MeshController::size_options() const {
  adapt::SizeFieldOptions sizes;
  sizes.max_size = options_.max_size * scales_.length;
  sizes.curvature_angle = is_final_ ? options_.final_curvature_angle : options_.curvature_angle;
  sizes.interface_size = is_final_ ? options_.final_interface_size : options_.interface_size;
  return sizes;
}

std::vector<Request> MeshController::ask(const StepView& view, std::string reason) {
  last_change_ = view.report.counts.steps;
  new_quality_.reset();
  return {Remesh{size_options(), static_cast<double>(options_.max_nodes), std::move(reason)}};
}

/// Why the mesh does not fit the surface.
std::optional<std::string> MeshController::misfit(const StepView& view) const {
  const bool is_near_rest = is_final_ && is_slow(view);
  if (is_near_rest && view.report.gradient) return std::nullopt;
  const Eigen::VectorXd sizes =
      wanted_sizes(model_, view.state, size_options(), options_.max_nodes);
  const mesh::Surface surface = view.state.surface();
  const double edge = adapt::longest_relative_edge(surface, sizes);
  if (edge > (is_near_rest ? emergency_edge_near_rest : emergency_edge))
    return fmt::format("an edge is {:.2f} of its size", edge);
  if (!may_change(view)) return std::nullopt;
  const double quality = view.diagnostics.quality;
  if (quality < low_quality && quality < lost_quality * *new_quality_)
    return fmt::format("the quality fell to {:.2f}", quality);
  if (!is_final_ && edge > long_edge) return fmt::format("an edge is {:.2f} of its size", edge);
  const double wanted = adapt::wanted_nodes(surface, sizes);
  if (wanted < surplus_nodes * surface.triangulation->num_nodes())
    return fmt::format("{:.0f} nodes are wanted", wanted);
  return std::nullopt;
}

bool MeshController::may_change(const StepView& view) const {
  const long wait = view.report.gradient ? steps_of_minimiser : options_.min_steps;
  return view.report.counts.steps - last_change_ >= wait;
}

bool MeshController::is_slow(const StepView& view) const {
  return view.report.gradient ? *view.report.gradient < near_minimum : speed(view) <= slow;
}

bool MeshController::is_moving(const StepView& view) const {
  return view.report.gradient ? *view.report.gradient > far_from_minimum : speed(view) > moving;
}

/// Tells whether a minimiser has been at an equilibrium on the fine mesh and is under way again.
bool MeshController::has_left_saddle(const StepView& view) {
  const auto distance = view.report.gradient;
  was_at_equilibrium_ = is_final_ && distance && (*distance < at_minimum || was_at_equilibrium_);
  return was_at_equilibrium_ && *distance > near_minimum;
}

/// Of the surface along its normal, without rigid motion, in natural units.
double MeshController::speed(const StepView& view) const {
  return view.diagnostics.velocity.normal_rigid_free / scales_.velocity_norm();
}

}  // namespace vesica::relax
