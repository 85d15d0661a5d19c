#include "vesica/model/schedule.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include "vesica/core/error.hpp"

namespace vesica::model {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool all_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

std::string text_of_points(ScheduleKind kind, std::span<const double> times,
                           std::span<const double> values) {
  return fmt::format("{{ times = [{}], values = [{}], kind = \"{}\" }}", fmt::join(times, ", "),
                     fmt::join(values, ", "), name_of(kind));
}

}  // namespace

Schedule Schedule::ramp(double from, double to, double start, double end) {
  return points(ScheduleKind::linear, {start, end}, {from, to});
}

Schedule Schedule::points(ScheduleKind kind, std::vector<double> times,
                          std::vector<double> values) {
  const auto rule = broken_rule(times, values);
  if (!rule.empty())
    throw ConfigError(fmt::format("{}: {}", text_of_points(kind, times, values), rule));
  Schedule schedule;
  schedule.kind_ = kind;
  schedule.times_ = std::move(times);
  schedule.values_ = std::move(values);
  return schedule;
}

std::string_view Schedule::broken_rule(std::span<const double> times,
                                       std::span<const double> values) {
  if (times.size() != values.size()) return "must have as many times as values";
  if (times.size() < 2) return "must have at least two times";
  if (!all_finite(times) || !all_finite(values)) return "must be finite";
  if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
    return "must have ascending times";
  return {};
}

/// The number of points before `time`.
std::size_t Schedule::piece(double time) const {
  return static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), time) -
                                  times_.begin());
}

double Schedule::value(double time) const {
  const std::size_t i = piece(time);
  if (i == 0) return first();
  if (i == times_.size()) return last();
  if (kind_ == ScheduleKind::stages) return values_[i - 1];
  return std::lerp(values_[i - 1], values_[i],
                   (time - times_[i - 1]) / (times_[i] - times_[i - 1]));
}

double Schedule::rate(double time) const {
  const std::size_t i = piece(time);
  if (i == 0 || i == times_.size() || kind_ == ScheduleKind::stages) return 0;
  return (values_[i] - values_[i - 1]) / (times_[i] - times_[i - 1]);
}

bool Schedule::is_constant() const {
  return std::all_of(values_.begin(), values_.end(), [this](double v) { return v == first(); });
}

double Schedule::next_kink(double time) const {
  if (is_constant()) return infinity;
  const auto next = std::upper_bound(times_.begin(), times_.end(), time);
  return next == times_.end() ? infinity : *next;
}

bool Schedule::jumps_at(double time) const {
  if (kind_ != ScheduleKind::stages) return false;
  const std::size_t i = piece(time);
  return i > 0 && i < times_.size() && times_[i] == time && values_[i] != values_[i - 1];
}

double Schedule::rests_after() const { return is_constant() ? -infinity : times_.back(); }

Schedule Schedule::scaled(double factor) const {
  Schedule result = *this;
  for (double& value : result.values_) value *= factor;
  return result;
}

Schedule Schedule::with_values(std::vector<double> values) const {
  if (times_.empty()) return values.front();
  return points(kind_, times_, std::move(values));
}

std::string text_of(const Schedule& schedule) {
  const auto times = schedule.times();
  const auto values = schedule.values();
  if (times.empty()) return fmt::format("{}", schedule.first());
  if (schedule.kind() == ScheduleKind::linear && times.size() == 2)
    return fmt::format("[{}, {}, {}, {}]", values[0], values[1], times[0], times[1]);
  return text_of_points(schedule.kind(), times, values);
}

}  // namespace vesica::model
