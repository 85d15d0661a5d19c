#include "vesica/model/make_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "vesica/core/error.hpp"

namespace vesica::model {
namespace {

/// Rounding in given numbers: a target may pass its bound by this much, relative.
constexpr double tolerance = 1e-12;

double characteristic_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }

double ball_volume(double radius) { return 4 * std::numbers::pi / 3 * std::pow(radius, 3); }

std::string text_of(const Ramp& ramp) {
  if (ramp.is_constant()) return fmt::format("{}", ramp.from);
  return fmt::format("[{}, {}, {}, {}]", ramp.from, ramp.to, ramp.start, ramp.end);
}

/// How a target stands in the case file, with what "initial" came out as.
std::string text_of(const Target& target, const Ramp& resolved) {
  if (target.kind == TargetKind::initial) return fmt::format("initial ({:.6g})", resolved.from);
  return text_of(resolved);
}

/// Throws the ConfigError of `constraints.<key>`.
template <class T>
[[noreturn]] void refuse(std::string_view key, const T& value, std::string_view rule) {
  throw ConfigError(fmt::format("constraints.{} = {}: {}", key, value, rule));
}

bool is_given(const Target& target) { return !(target == Target{}); }

void check_ramp(std::string_view key, const Ramp& ramp) {
  for (const double number : {ramp.from, ramp.to, ramp.start, ramp.end}) {
    if (!std::isfinite(number)) refuse(key, text_of(ramp), "must be finite");
  }
  if (ramp.end < ramp.start) {
    refuse(key, fmt::format("[{}, {}, {}, {}]", ramp.from, ramp.to, ramp.start, ramp.end),
           "must end at t1 >= t0");
  }
}

void check_positive(std::string_view key, const Target& target, const Ramp& ramp) {
  if (!(ramp.from > 0 && ramp.to > 0)) refuse(key, text_of(target, ramp), "must be > 0");
}

/// The target before bounds are looked at; absent when it is free or `start` does not have it.
std::optional<Ramp> resolve(std::string_view key, const Target& target,
                            std::optional<double> start) {
  if (target.kind == TargetKind::free) return std::nullopt;
  if (target.kind == TargetKind::initial) {
    if (!start) return std::nullopt;
    return Ramp::constant(*start);
  }
  check_ramp(key, target.ramp);
  return target.ramp;
}

/// Refuses a reduced number beside its dimensional one, out of range, or without an area.
void check_reduced(const Field& field, double value, std::string_view partner, bool partner_given,
                   const std::optional<Ramp>& area) {
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

/// The area target with both ends multiplied.
Ramp scaled(const Ramp& area, double factor_from, double factor_to) {
  return {area.from * factor_from, area.to * factor_to, area.start, area.end};
}

/// Largest reduced volume at any time. Where both targets change linearly, V = v0 + v1 s and
/// A = a0 + a1 s, V / A^(3/2) has at most one extremum, at v1 A = 3/2 a1 V.
double largest_reduced_volume(const Ramp& volume, const Ramp& area) {
  const auto at = [&](double time) {
    return volume.value(time) / ball_volume(characteristic_radius(area.value(time)));
  };
  double largest = std::max(volume.from / ball_volume(characteristic_radius(area.from)),
                            volume.to / ball_volume(characteristic_radius(area.to)));
  for (const double time : {volume.start, volume.end, area.start, area.end}) {
    largest = std::max(largest, at(time));
  }
  const double begin = std::max(volume.start, area.start);
  const double end = std::min(volume.end, area.end);
  const double v1 = volume.rate(begin);
  const double a1 = area.rate(begin);
  if (begin < end && v1 != 0 && a1 != 0) {
    const double s = 2 * area.value(begin) / a1 - 3 * volume.value(begin) / v1;
    if (s > 0 && begin + s < end) largest = std::max(largest, at(begin + s));
  }
  return largest;
}

std::optional<Ramp> volume_target(const ConstraintOptions& options, const Measures& start,
                                  const std::optional<Ramp>& area) {
  if (options.reduced_volume) {
    const double reduced = *options.reduced_volume;
    check_reduced({"reduced_volume", "-", "", Rule::positive}, reduced, "volume",
                  is_given(options.volume), area);
    if (reduced > 1 + tolerance) {
      refuse("reduced_volume", reduced, "must be <= 1: no surface of this area encloses more");
    }
    const double from = reduced * ball_volume(characteristic_radius(area->from)) / area->from;
    const double to = reduced * ball_volume(characteristic_radius(area->to)) / area->to;
    return scaled(*area, from, to);
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
    refuse("reduced_volume", *options.reduced_volume, rule + " (volume is linear in time)");
  }
  refuse("volume", text_of(options.volume, *targets.volume), rule);
}

void check_single_phase(const ConstraintOptions& options) {
  constexpr std::string_view rule = "must be left out: the vesicle has a single phase";
  if (options.phase_difference.kind == TargetKind::prescribed) {
    refuse("phase_difference", text_of(options.phase_difference.ramp), rule);
  }
  if (options.phase_fraction) refuse("phase_fraction", *options.phase_fraction, rule);
}

/// |A_1 - A_2| < A at all times; both change linearly between the times looked at. At equality one
/// phase is empty, h'(c) = 0 everywhere and no phase field can be moved to keep the target.
void check_phase_difference(const Target& target, const Ramp& phase, const Ramp& area) {
  const auto check = [&](double difference, double area_then) {
    if (std::abs(difference) < area_then * (1 - tolerance)) return;
    refuse("phase_difference", text_of(target, phase),
           fmt::format("must lie between -area and area ({:.5g})", area_then));
  };
  check(phase.from, area.from);
  check(phase.to, area.to);
  for (const double time : {phase.start, phase.end, area.start, area.end}) {
    check(phase.value(time), area.value(time));
  }
}

std::optional<Ramp> phase_target(const ConstraintOptions& options, const Measures& start,
                                 const std::optional<Ramp>& area) {
  if (options.phase_fraction) {
    const double fraction = *options.phase_fraction;
    check_reduced({"phase_fraction", "-", "", Rule::fraction}, fraction, "phase_difference",
                  is_given(options.phase_difference), area);
    if (fraction == 0 || fraction == 1) {
      refuse("phase_fraction", fraction, "must lie between 0 and 1: one phase would be empty");
    }
    return scaled(*area, 1 - 2 * fraction, 1 - 2 * fraction);
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
