#include "vesica/model/make_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/refuse.hpp"
#include "vesica/core/check.hpp"

namespace vesica::model {
namespace {

/// Rounding in given numbers: a target may pass its bound by this much, relative.
constexpr double tolerance = 1e-12;

double characteristic_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A schedule there has the value of the piece that begins at `time`.
double just_after(double time) { return std::nextafter(time, infinity); }

double ball_volume(double radius) { return 4 * std::numbers::pi / 3 * std::pow(radius, 3); }

/// How a target stands in the case file, with what "initial" came out as.
std::string text_of(const Target& target, const Schedule& resolved) {
  if (target.kind == TargetKind::initial) return fmt::format("initial ({:.6g})", resolved.first());
  return model::text_of(resolved);
}

/// Throws the ConfigError of `constraints.<key>`.
template <class T>
[[noreturn]] void refuse(std::string_view key, const T& value, std::string_view rule) {
  vesica::refuse(fmt::format("constraints.{}", key), value, rule);
}

void check_given_once(const Target& target, std::string_view key, std::string_view reduced_key,
                      std::optional<double> reduced) {
  if (reduced && target != Target{})
    refuse(reduced_key, *reduced,
           fmt::format("constraints.{} is given too; give one of them", key));
}

void check_positive(std::string_view key, const Target& target, const Schedule& schedule) {
  for (const double value : schedule.values()) {
    if (!(value > 0)) refuse(key, text_of(target, schedule), "must be > 0");
  }
}

/// The target before bounds are looked at; absent when it is free or `start` does not have it.
std::optional<Schedule> resolve(const Target& target, std::optional<double> start) {
  if (target.kind == TargetKind::free) return std::nullopt;
  const bool needs_start = target.kind == TargetKind::initial || target.begins_at_start;
  if (needs_start && !start) return std::nullopt;
  if (target.kind == TargetKind::initial) return Schedule(*start);
  if (!target.begins_at_start) return target.schedule;
  std::vector<double> values(target.schedule.values().begin(), target.schedule.values().end());
  values.front() = *start;
  return target.schedule.with_values(std::move(values));
}

/// A reduced number needs an area to refer to.
void check_has_area(std::string_view key, double value, const std::optional<Schedule>& area) {
  if (!area) refuse(key, value, "needs an area to refer to, but constraints.area is free");
}

/// The pieces in which both schedules are linear, as times (begin, end]; the ends of time are left
/// out, where both rest.
std::vector<std::pair<double, double>> common_pieces(const Schedule& a, const Schedule& b) {
  std::vector<double> times(a.times().begin(), a.times().end());
  times.insert(times.end(), b.times().begin(), b.times().end());
  std::sort(times.begin(), times.end());
  std::vector<std::pair<double, double>> pieces;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i - 1] < times[i]) pieces.emplace_back(just_after(times[i - 1]), times[i]);
  }
  return pieces;
}

/// Calls visit(time) where a quotient of the schedules may be extreme: before and after every kink
/// and jump.
template <class Visit>
void for_each_extreme_time(const Schedule& a, const Schedule& b, Visit&& visit) {
  visit(-infinity);
  for (const auto& [begin, end] : common_pieces(a, b)) {
    visit(begin);
    visit(end);
  }
  visit(infinity);
}

/// Largest reduced volume at any time. Where both targets change linearly, V = v0 + v1 s and
/// A = a0 + a1 s, V / A^(3/2) has at most one extremum, at v1 A = 3/2 a1 V.
double largest_reduced_volume(const Schedule& volume, const Schedule& area) {
  double largest = 0;
  const auto look_at = [&](double time) {
    const double radius = characteristic_radius(area.value(time));
    largest = std::max(largest, volume.value(time) / ball_volume(radius));
  };
  for_each_extreme_time(volume, area, look_at);
  for (const auto& [begin, end] : common_pieces(volume, area)) {
    const double v1 = volume.rate(end);
    const double a1 = area.rate(end);
    if (v1 == 0 || a1 == 0) continue;
    const double s = 2 * area.value(begin) / a1 - 3 * volume.value(begin) / v1;
    if (s > 0 && begin + s < end) look_at(begin + s);
  }
  return largest;
}

/// The target of the volume that a reduced volume stands for.
Schedule volume_of(const ConstraintOptions& options, const std::optional<Schedule>& area) {
  const double reduced = *options.reduced_volume;
  check_has_area("reduced_volume", reduced, area);
  if (reduced > 1 + tolerance)
    refuse("reduced_volume", reduced, "must be <= 1: no surface of this area encloses more");
  std::vector<double> volumes;
  for (const double value : area->values())
    volumes.push_back(reduced * ball_volume(characteristic_radius(value)));
  return area->with_values(std::move(volumes));
}

/// The volume against the area of the same time; what the start has is possible by itself.
void check_reduced_volume(const ConstraintOptions& options, const Targets& targets) {
  const auto& volume = targets.of<Volume>();
  const auto& area = targets.of<Area>();
  if (!volume || !area) return;
  const Target& volume_option = options.targets.of<Volume>();
  const Target& area_option = options.targets.of<Area>();
  if (volume_option.kind == TargetKind::initial && area_option.kind == TargetKind::initial &&
      !options.reduced_volume) {
    return;
  }
  const double reduced = largest_reduced_volume(*volume, *area);
  if (reduced <= 1 + tolerance) return;
  const auto rule = fmt::format(
      "the reduced volume reaches {:.6g} with area = {}: must be <= 1: no surface of this area "
      "encloses more",
      reduced, text_of(area_option, *area));
  if (options.reduced_volume) {
    refuse("reduced_volume", *options.reduced_volume,
           rule + " (volume is linear between the times of the area)");
  }
  refuse(Volume::key, text_of(volume_option, *volume), rule);
}

void check_single_phase(const ConstraintOptions& options) {
  constexpr std::string_view rule = "must be left out: the vesicle has a single phase";
  for_each_term<Constraints>([&]<class Constraint>(std::size_t) {
    const Target& target = options.targets.of<Constraint>();
    if (Constraint::needs_phase_field && target.kind == TargetKind::prescribed)
      refuse(Constraint::key, model::text_of(target.schedule), rule);
  });
  if (options.phase_fraction) refuse("phase_fraction", *options.phase_fraction, rule);
}

/// |A_1 - A_2| < A at all times; both change linearly between the times looked at. At equality one
/// phase is empty, h'(c) = 0 everywhere and no phase field can be moved to keep the target.
void check_phase_difference(const Target& target, const Schedule& phase, const Schedule& area) {
  const auto check = [&](double difference, double area_then) {
    if (std::abs(difference) < area_then * (1 - tolerance)) return;
    refuse(PhaseDifference::key, text_of(target, phase),
           fmt::format("must lie between -area and area ({:.5g})", area_then));
  };
  for_each_extreme_time(phase, area,
                        [&](double time) { check(phase.value(time), area.value(time)); });
}

/// The target of the phase difference that a phase fraction stands for.
Schedule phase_difference_of(const ConstraintOptions& options,
                             const std::optional<Schedule>& area) {
  const double fraction = *options.phase_fraction;
  check_has_area("phase_fraction", fraction, area);
  if (fraction == 0 || fraction == 1)
    refuse("phase_fraction", fraction, "must lie between 0 and 1: one phase would be empty");
  return area->scaled(1 - 2 * fraction);
}

}  // namespace

void ConstraintOptions::check_together() const {
  check_given_once(targets.of<Volume>(), Volume::key, "reduced_volume", reduced_volume);
  check_given_once(targets.of<PhaseDifference>(), PhaseDifference::key, "phase_fraction",
                   phase_fraction);
}

Targets make_targets(const ConstraintOptions& options, const Measures& start, bool is_two_phase) {
  check("constraints", options);
  Targets targets;
  for_each_term<Constraints>([&]<class Constraint>(std::size_t) {
    if (Constraint::needs_phase_field && !is_two_phase) return;
    targets.of<Constraint>() = resolve(options.targets.of<Constraint>(), start.of<Constraint>());
  });
  const auto& area = targets.of<Area>();
  auto& volume = targets.of<Volume>();
  if (area) check_positive(Area::key, options.targets.of<Area>(), *area);
  if (options.reduced_volume) volume = volume_of(options, area);
  if (volume) check_positive(Volume::key, options.targets.of<Volume>(), *volume);
  check_reduced_volume(options, targets);
  if (!is_two_phase) {
    check_single_phase(options);
    return targets;
  }
  auto& phase = targets.of<PhaseDifference>();
  if (options.phase_fraction) phase = phase_difference_of(options, area);
  if (phase && area && !options.phase_fraction)
    check_phase_difference(options.targets.of<PhaseDifference>(), *phase, *area);
  return targets;
}

}  // namespace vesica::model
