#include "scaled_stepper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>
#include <utility>

#include "vesica/problem/scales.hpp"

namespace vesica::run {
namespace {

constexpr int ordinary = 3;  // powers of two

int nearest_power(double value) { return static_cast<int>(std::lround(std::log2(value))); }

void convert(problem::Fields& fields, const model::Units& units) {
  fields.positions /= units.length;
  fields.mean_curvature *= units.length;
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    auto& multiplier = fields.multipliers[place];
    if (multiplier) *multiplier *= std::pow(units.length, Constraint::length_power) / units.energy;
  });
}

}  // namespace

model::Units near_natural_units(const model::Model& model, const problem::State& start) {
  const problem::Scales scales = problem::scales_of(model, start);
  const int length = nearest_power(scales.length);
  const int energy = nearest_power(scales.energy);
  if (std::abs(length) <= ordinary && std::abs(energy) <= ordinary) return {};
  return {std::ldexp(1.0, length), std::ldexp(1.0, energy)};
}

problem::State in_units(const problem::State& state, const model::Units& units) {
  problem::State result = state;
  result.damping /= units.length * units.length / units.energy;
  convert(result.values, units);
  convert(result.rates, units);
  result.rates.positions *= units.time();
  result.rates.mean_curvature *= units.time();
  result.rates.order_parameter *= units.time();
  for (auto& rate : result.rates.multipliers.values) {
    if (rate) *rate *= units.time();
  }
  return result;
}

solve::SolverOptions in_units(const solve::SolverOptions& options, const model::Units& units,
                              double interface_width) {
  solve::SolverOptions result = options;
  solve::SolverOptions::fields(result, [&]<class T>(const Field& field, T& value) {
    if constexpr (std::is_same_v<T, double>) {
      value /= units.of(field.unit);
    } else if constexpr (std::is_same_v<T, solve::TimeStep>) {
      if (value.value || interface_width > 0)
        value.value = value.resolved(interface_width) / units.of(field.unit);
    }
  });
  return result;
}

ScaledStepper::ScaledStepper(std::unique_ptr<solve::Stepper> stepper, const model::Units& units,
                             double clock)
    : stepper_(std::move(stepper)), units_(units), clock_(clock) {
  take_state();
}

void ScaledStepper::take_state() {
  state_ = in_units(stepper_->state(), units_.inverse());
  state_.time *= clock_;
}

std::optional<model::EnergyParts> ScaledStepper::energy() const {
  auto energy = stepper_->energy();
  if (!energy) return energy;
  for (auto& part : energy->values) {
    if (part) *part *= units_.energy;
  }
  return energy;
}

solve::StepReport ScaledStepper::step(double end_time) {
  return converted(stepper_->step(end_time / clock_));
}

solve::StepReport ScaledStepper::finish() { return converted(stepper_->finish()); }

void ScaledStepper::set_damping(double alpha) {
  stepper_->set_damping(alpha / (units_.length * units_.length / units_.energy));
  take_state();
}

solve::StepReport ScaledStepper::converted(solve::StepReport report) {
  take_state();
  report.time *= clock_;
  report.step_size *= clock_;
  if (report.polish) report.polish->curvature.value /= units_.time();
  if (report.status == solve::StepStatus::failed) {
    report.reason += fmt::format(" (lengths in this message are in {:.4g}, times in {:.4g})",
                                 units_.length, clock_);
  }
  return report;
}

}  // namespace vesica::run
