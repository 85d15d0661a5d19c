#include "vesica/relax/decay_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesica::relax {
namespace {

constexpr double rise = 1e-2;  // relative
constexpr int steps_of_decay = 10;
constexpr double constraint = 1e-3;  // of a state that counts

}  // namespace

bool DecayWatch::has_decayed(const StepView& view) {
  if (view.report.gradient || view.state.time <= model_.rests_after()) {
    forget();
    return false;
  }
  now_ = view.diagnostics.energy.total();
  time_ = view.state.time;
  const auto& errors = view.diagnostics.constraint_errors.values;
  const bool counts = std::all_of(errors.begin(), errors.end(), [](const auto& error) {
    return std::abs(error.value_or(0)) < constraint;
  });
  if (counts && (!best_ || now_ < least_)) {
    best_ = view.state;
    least_ = now_;
  }
  const double rigidity = model_.material.bending_rigidity.phase_1.last();
  const double unit = std::max(std::abs(least_), 8 * std::numbers::pi * rigidity);
  const bool is_above = best_ && now_ > least_ + rise * unit;
  steps_above_ = is_above ? steps_above_ + 1 : 0;
  return steps_above_ >= steps_of_decay;
}

problem::State DecayWatch::best() const {
  problem::State state = best_.value();
  state.time = time_;
  return state;
}

Stop DecayWatch::stop() const {
  return {RunStatus::unresolved,
          fmt::format("the energy rose from {:.8g} to {:.8g}, which that of a gradient flow does "
                      "not: the mesh decays; the state of least energy is kept; adaption.enabled = "
                      "true, another method or a finer mesh may help",
                      least_, now_)};
}

void DecayWatch::forget() {
  best_.reset();
  steps_above_ = 0;
}

}  // namespace vesica::relax
