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

#include "vesica/core/error.hpp"

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
  throw ConfigError(fmt::format("constraints.{} = {}: {}", key, value, rule));
}

bool is_given(const Target& target) { return !(target == Target{}); }

void check_finite(std::string_view key, const Schedule& schedule) {
  for (const double value : schedule.values()) {
    if (!std::isfinite(value)) refuse(key, model::text_of(schedule), "must be finite");
  }
}

void check_positive(std::string_view key, const Target& target, const Schedule& schedule) {
  for (const double value : schedule.values()) {
    if (!(value > 0)) refuse(key, text_of(target, schedule), "must be > 0");
  }
}

/// The target before bounds are looked at; absent when it is free or `start` does not have it.
std::optional<Schedule> resolve(std::string_view key, const Target& target,
                                std::optional<double> start) {
  if (target.kind == TargetKind::free) return std::nullopt;
  const bool needs_start = target.kind == TargetKind::initial || target.begins_at_start;
  if (needs_start && !start) return std::nullopt;
  if (target.kind == TargetKind::initial) return Schedule(*start);
  check_finite(key, target.schedule);
  if (!target.begins_at_start) return target.schedule;
  std::vector<double> values(target.schedule.values().begin(), target.schedule.values().end());
  values.front() = *start;
  return target.schedule.with_values(std::move(values));
}

/// Refuses a reduced number beside its dimensional one, out of range, or without an area.
void check_reduced(const Field& field, double value, std::string_view partner, bool partner_given,
                   const std::optional<Schedule>& area) {
  if (!std::isfinite(value) || !satisfies(field.rule, value)) {
    refuse(field.name, value, rule_text(field.rule));
  }
  if (partner_given) {
    refuse(field.name, value,
           fmt::format("constraints.{} is given too; give one of them", partner));
  }
  if (!area) {
    refuse(field.name, value, "needs an area to refer to, but constraints.area is free");
  }
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

std::optional<Schedule> volume_target(const ConstraintOptions& options, const Measures& start,
                                      const std::optional<Schedule>& area) {
  if (options.reduced_volume) {
    const double reduced = *options.reduced_volume;
    check_reduced({"reduced_volume", "-", "", Rule::positive}, reduced, "volume",
                  is_given(options.volume), area);
    if (reduced > 1 + tolerance) {
      refuse("reduced_volume", reduced, "must be <= 1: no surface of this area encloses more");
    }
    std::vector<double> volumes;
    for (const double value : area->values())
      volumes.push_back(reduced * ball_volume(characteristic_radius(value)));
    return area->with_values(std::move(volumes));
  }
  const auto volume = resolve("volume", options.volume, start.volume);
  if (volume) check_positive("volume", options.volume, *volume);
  return volume;
}

/// The volume against the area of the same time; what the start has is possible by itself.
void check_reduced_volume(const ConstraintOptions& options, const Targets& targets) {
  if (!targets.volume || !targets.area) return;
  if (options.volume.kind == TargetKind::initial && options.area.kind == TargetKind::initial &&
      !options.reduced_volume) {
    return;
  }
  const double reduced = largest_reduced_volume(*targets.volume, *targets.area);
  if (reduced <= 1 + tolerance) return;
  const auto rule = fmt::format(
      "the reduced volume reaches {:.6g} with area = {}: must be <= 1: no surface of this area "
      "encloses more",
      reduced, text_of(options.area, *targets.area));
  if (options.reduced_volume) {
    refuse("reduced_volume", *options.reduced_volume,
           rule + " (volume is linear between the times of the area)");
  }
  refuse("volume", text_of(options.volume, *targets.volume), rule);
}

void check_single_phase(const ConstraintOptions& options) {
  constexpr std::string_view rule = "must be left out: the vesicle has a single phase";
  if (options.phase_difference.kind == TargetKind::prescribed) {
    refuse("phase_difference", model::text_of(options.phase_difference.schedule), rule);
  }
  if (options.phase_fraction) refuse("phase_fraction", *options.phase_fraction, rule);
}

/// |A_1 - A_2| < A at all times; both change linearly between the times looked at. At equality one
/// phase is empty, h'(c) = 0 everywhere and no phase field can be moved to keep the target.
void check_phase_difference(const Target& target, const Schedule& phase, const Schedule& area) {
  const auto check = [&](double difference, double area_then) {
    if (std::abs(difference) < area_then * (1 - tolerance)) return;
    refuse("phase_difference", text_of(target, phase),
           fmt::format("must lie between -area and area ({:.5g})", area_then));
  };
  for_each_extreme_time(phase, area,
                        [&](double time) { check(phase.value(time), area.value(time)); });
}

std::optional<Schedule> phase_target(const ConstraintOptions& options, const Measures& start,
                                     const std::optional<Schedule>& area) {
  if (options.phase_fraction) {
    const double fraction = *options.phase_fraction;
    check_reduced({"phase_fraction", "-", "", Rule::fraction}, fraction, "phase_difference",
                  is_given(options.phase_difference), area);
    if (fraction == 0 || fraction == 1) {
      refuse("phase_fraction", fraction, "must lie between 0 and 1: one phase would be empty");
    }
    return area->scaled(1 - 2 * fraction);
  }
  const auto phase = resolve("phase_difference", options.phase_difference, start.phase_difference);
  if (phase && area) check_phase_difference(options.phase_difference, *phase, *area);
  return phase;
}

}  // namespace

Targets make_targets(const ConstraintOptions& options, const Measures& start, bool is_two_phase) {
  Targets targets;
  targets.area = resolve("area", options.area, start.area);
  if (targets.area) check_positive("area", options.area, *targets.area);
  targets.volume = volume_target(options, start, targets.area);
  check_reduced_volume(options, targets);
  if (is_two_phase) {
    targets.phase_difference = phase_target(options, start, targets.area);
  } else {
    check_single_phase(options);
  }
  return targets;
}

}  // namespace vesica::model
