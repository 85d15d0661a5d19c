#include "vesica/relax/stationarity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vesica/core/check.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::relax {

namespace {

constexpr double resolved_cosine = 0.6;  // above 0.8 where the error of the energy is below 1e-3

/// Multipliers in k/R_c^3 (volume) and k/R_c^2 (area, phase), so that they can be compared.
std::array<double, model::num_constraints> in_natural_units(const model::PerConstraint& multipliers,
                                                            double radius, double rigidity) {
  std::array<double, model::num_constraints> result{};
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    result[place] =
        multipliers[place].value_or(0) * std::pow(radius, Constraint::length_power) / rigidity;
  });
  return result;
}

}  // namespace

Stationarity::Stationarity(const StopOptions& options, const model::Model& model)
    : options_(checked("stop", options)), model_(model) {}

bool Stationarity::is_at_rest(const StepView& view) {
  steps_at_rest_ = multipliers_moved(view) ? 0 : steps_at_rest_ + 1;
  last_multipliers_ = view.state.values.multipliers;
  const long newton = view.report.counts.newton;
  steps_without_newton_ = newton == last_newton_ ? steps_without_newton_ + 1 : 0;
  last_newton_ = newton;
  const bool counts_rest = !view.report.gradient;
  return (!counts_rest || steps_at_rest_ >= options_.rest_steps) &&
         steps_without_newton_ >= options_.steps_without_newton && meets_velocity(view) &&
         view.state.time > model_.rests_after();
}

void Stationarity::forget_steps() {
  last_multipliers_.reset();
  steps_at_rest_ = 0;
  steps_without_newton_ = 0;
}

bool Stationarity::meets_velocity(const StepView& view) const {
  if (view.report.gradient) return *view.report.gradient < options_.gradient;
  return normal_velocity(view.diagnostics) < options_.normal_velocity;
}

double Stationarity::normal_velocity(const measure::Diagnostics& diagnostics) const {
  const double radius = diagnostics.characteristic_radius();
  const double rigidity = model_.material.bending_rigidity.phase_1.last();
  return diagnostics.velocity.normal_rigid_free * radius * radius / rigidity;
}

bool Stationarity::meets_constraints(const measure::Diagnostics& diagnostics) const {
  const auto& errors = diagnostics.constraint_errors.values;
  return std::all_of(errors.begin(), errors.end(), [&](const auto& error) {
    return std::abs(error.value_or(0)) < options_.constraint;
  });
}

bool Stationarity::multipliers_moved(const StepView& view) const {
  if (!last_multipliers_) return true;
  const double radius = view.diagnostics.characteristic_radius();
  const double rigidity = model_.material.bending_rigidity.phase_1.last();
  const auto now = in_natural_units(view.state.values.multipliers, radius, rigidity);
  const auto before = in_natural_units(*last_multipliers_, radius, rigidity);
  double largest = 1;
  double change = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    largest = std::max(largest, std::abs(now[i]));
    change = std::max(change, std::abs(now[i] - before[i]));
  }
  return change > options_.multiplier_change * largest;
}

std::string Stationarity::rest_text(const StepView& view) const {
  if (view.report.gradient) {
    return fmt::format("distance to the minimum {:.2e} below {:g}, constraints met",
                       *view.report.gradient, options_.gradient);
  }
  return fmt::format(
      "normal velocity {:.2e} below {:g} k/R_c^3, multipliers at rest, constraints met",
      normal_velocity(view.diagnostics), options_.normal_velocity);
}

std::optional<Stop> Stationarity::unresolved(const problem::State& state) {
  const double cosine = mesh::smallest_normal_cosine(*state.triangulation, state.values.positions);
  if (cosine > resolved_cosine) return std::nullopt;
  return Stop{RunStatus::unresolved,
              fmt::format("the mesh is too coarse for the shape: normals of "
                          "neighbouring elements differ by up to {:.0f} degrees; adaption.enabled "
                          "= true, more adaption.max_nodes or a finer mesh may help",
                          std::acos(std::max(-1.0, cosine)) * 180 / std::numbers::pi)};
}

std::optional<Stop> Stationarity::limit(const StepView& view) const {
  if (view.state.time >= options_.end_time) {
    return Stop{RunStatus::end_time, fmt::format("stop.end_time = {} reached", options_.end_time)};
  }
  if (view.report.counts.steps >= options_.max_steps) {
    return Stop{RunStatus::step_limit,
                fmt::format("stop.max_steps = {} reached", options_.max_steps)};
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (elapsed.count() >= options_.max_seconds) {
    return Stop{RunStatus::time_limit,
                fmt::format("stop.max_seconds = {} reached", options_.max_seconds)};
  }
  return std::nullopt;
}

}  // namespace vesica::relax
