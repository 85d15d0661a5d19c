#include "vesica/relax/bisection_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "vesica/core/check.hpp"
#include "vesica/paper/conformal_map.hpp"
#include "vesica/relax/remesh.hpp"

namespace vesica::relax {
namespace {

constexpr double lost_quality = 0.75;
constexpr int max_changes_after_failures = 5;
constexpr int max_changes_at_rest = 10;

}  // namespace

BisectionController::BisectionController(const AdaptionOptions& options, model::Model model,
                                         const problem::Scales& scales)
    : options_(checked("adaption", options)), model_(std::move(model)), scales_(scales) {}

std::vector<Request> BisectionController::respond(const StepView& view) {
  if (!first_mesh_) {
    first_mesh_ = view.state.triangulation;
    if (options_.method == MeshMethod::conformal) paper::check_genus_zero(*first_mesh_);
  }
  if (std::exchange(is_new_image_, false)) image_quality_ = view.diagnostics.quality;
  if (view.report.counts.steps - last_change_ < options_.every) return {};
  if (has_low_quality(view))
    return ask_for_image(view, fmt::format("the quality fell to {:.2f}", view.diagnostics.quality));
  return ask_for_bisection(view, "of the marking strategy");
}

std::vector<Request> BisectionController::respond_to_failure(const StepView& view) {
  if (changes_after_failures_ == max_changes_after_failures) return {};
  ++changes_after_failures_;
  if (options_.method == MeshMethod::conformal) return ask_for_image(view, "a step failed");
  return ask_for_bisection(view, "a step failed");
}

std::vector<Request> BisectionController::respond_to_rest(const StepView& view) {
  if (changes_at_rest_ == max_changes_at_rest) return {};
  const auto marks = wanted_marks(model_, view.state, marking(), options_.max_nodes);
  const auto num_large = std::count(marks.begin(), marks.end(), paper::Mark::refine);
  if (num_large == 0) return {};
  ++changes_at_rest_;
  return ask_for_bisection(
      view, fmt::format("{} elements are larger than wanted at the equilibrium", num_large));
}

paper::BisectionOptions BisectionController::marking() const {
  return {options_.n_in, options_.n_off, options_.n_kappa, options_.max_size * scales_.length};
}

BisectionPlan BisectionController::bisection(const StepView& view) const {
  return {marking(), view.state.triangulation == first_mesh_};
}

std::vector<Request> BisectionController::ask(const StepView& view, MeshPlan plan,
                                              std::string reason) {
  last_change_ = view.report.counts.steps;
  return {Remesh{std::move(plan), static_cast<double>(options_.max_nodes), std::move(reason)}};
}

std::vector<Request> BisectionController::ask_for_bisection(const StepView& view,
                                                            std::string reason) {
  return ask(view, bisection(view), std::move(reason));
}

std::vector<Request> BisectionController::ask_for_image(const StepView& view, std::string reason) {
  is_new_image_ = true;
  return ask(view, ConformalPlan{bisection(view)}, std::move(reason));
}

bool BisectionController::has_low_quality(const StepView& view) const {
  const double quality = view.diagnostics.quality;
  return options_.method == MeshMethod::conformal && quality < options_.conformal_quality &&
         quality < lost_quality * image_quality_;
}

}  // namespace vesica::relax
