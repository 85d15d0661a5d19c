#include "vesica/relax/damping_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/refuse.hpp"
#include "vesica/core/check.hpp"

namespace vesica::relax {

namespace {

/// alpha for the next step, in the units of the options.
double next_alpha(const DampingOptions& options, double alpha,
                  const measure::VelocityNorms& velocity) {
  const double factor = *options.factor;
  switch (options.kind) {
    case DampingKind::fixed:
      return *options.initial;
    case DampingKind::speed:
      if (velocity.normal <= 0) return alpha * factor;
      return std::clamp(options.gain / velocity.normal, alpha / factor, alpha * factor);
    case DampingKind::ratio:
    case DampingKind::paper:
      if (velocity.tangential > options.upper_ratio * velocity.normal) return alpha * factor;
      if (velocity.tangential < options.lower_ratio * velocity.normal) return alpha / factor;
      break;
  }
  return alpha;
}

DampingOptions with_defaults(DampingOptions options) {
  const bool is_paper = options.kind == DampingKind::paper;
  options.initial = options.initial.value_or(is_paper ? 1e-4 : 1);
  options.minimum = options.minimum.value_or(is_paper ? 1e-6 : 1e-2);
  options.maximum = options.maximum.value_or(is_paper ? 1e4 : 10);
  options.factor = options.factor.value_or(is_paper ? 10 : 2);
  return options;
}

}  // namespace

void DampingOptions::check_together() const {
  const DampingOptions all = with_defaults(*this);
  if (*all.minimum > *all.maximum) {
    refuse("damping.minimum", *all.minimum,
           fmt::format("must be <= damping.maximum = {}", *all.maximum));
  }
  if (kind != DampingKind::fixed && (*all.initial < *all.minimum || *all.initial > *all.maximum)) {
    refuse("damping.initial", *all.initial,
           fmt::format("must lie between damping.minimum = {} and damping.maximum = {}",
                       *all.minimum, *all.maximum));
  }
  if (lower_ratio >= upper_ratio) {
    refuse("damping.lower_ratio", lower_ratio,
           fmt::format("must be < damping.upper_ratio = {}", upper_ratio));
  }
}

DampingOptions resolved_damping(const DampingOptions& options) {
  return with_defaults(checked("damping", options));
}

DampingController::DampingController(const DampingOptions& options, const problem::Scales& scales)
    : options_(resolved_damping(options)), scales_(scales) {}

std::vector<Request> DampingController::respond(const StepView& view) {
  if (view.report.counts.steps == 0) return {SetDamping{*options_.initial * scales_.damping()}};
  measure::VelocityNorms velocity = view.diagnostics.velocity;
  velocity.normal /= scales_.velocity_norm();
  velocity.tangential /= scales_.velocity_norm();
  const double alpha = view.state.damping / scales_.damping();
  double next = next_alpha(options_, alpha, velocity);
  if (options_.kind != DampingKind::fixed)
    next = std::clamp(next, *options_.minimum, *options_.maximum);
  if (next == alpha) return {};
  return {SetDamping{next * scales_.damping()}};
}

}  // namespace vesica::relax
