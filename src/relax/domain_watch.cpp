#include "vesica/relax/domain_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace vesica::relax {
namespace {

constexpr int lasting_steps = 3;

int count(const std::vector<measure::PhaseDomain>& domains, int phase, double smallest_area) {
  return static_cast<int>(std::count_if(domains.begin(), domains.end(), [&](const auto& domain) {
    return domain.phase == phase && domain.area >= smallest_area;
  }));
}

}  // namespace

DomainWatch::DomainWatch(model::Schedule interface_width)
    : interface_width_(std::move(interface_width)) {}

std::vector<Event> DomainWatch::look(const StepView& view) {
  const double width = interface_width_.value(view.state.time);
  const double smallest_area = 0.25 * std::numbers::pi * width * width;
  std::vector<Event> events;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    Phase& phase = phases_[i];
    look(phase, count(view.diagnostics.domains, static_cast<int>(i) + 1, smallest_area), view);
    if (!phase.change || phase.change->lasted < lasting_steps) continue;
    events.push_back(event(i));
    phase.number = phase.change->number;
    phase.change.reset();
  }
  return events;
}

void DomainWatch::look(Phase& phase, int number, const StepView& view) {
  if (!phase.number) phase.number = number;
  if (number == *phase.number) {
    phase.change.reset();
    return;
  }
  if (!phase.change || phase.change->number != number)
    phase.change = Change{number, view.report.counts.steps, view.state.time, 0};
  ++phase.change->lasted;
}

std::vector<Event> DomainWatch::finish() const {
  std::vector<Event> events;
  for (std::size_t i = 0; i < phases_.size(); ++i)
    if (phases_[i].change) events.push_back(event(i));
  return events;
}

Event DomainWatch::event(std::size_t index) const {
  const Phase& phase = phases_[index];
  return {
      phase.change->step, phase.change->time,
      fmt::format("domains of phase {}: {} -> {}", index + 1, *phase.number, phase.change->number)};
}

}  // namespace vesica::relax
