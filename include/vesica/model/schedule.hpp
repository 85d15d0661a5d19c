#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"

namespace vesica::model {

/// How a schedule goes from point to point: linearly, or in stages that jump.
enum class ScheduleKind { linear, stages };

/// A quantity that may change in time: a constant; linear through points (t_i, v_i); or stages, v_0
/// before t_1 and v_i from t_i on. Before t_0 it is v_0, after the last time it rests at the last
/// value.
///
/// Where it has a kink or jumps, `value` and `rate` are those of the piece that ends there: a time
/// step that ends at a kink lies in one piece, and the next one begins in the next.
class Schedule {
 public:
  /// Makes a constant. Implicit, so that a number can stand where a schedule may.
  Schedule(double value = 0) : values_{value} {}  // NOLINT(google-explicit-constructor)

  /// Makes a ramp: `from` until `start`, linear in between, `to` from `end` on. Throws ConfigError
  /// as `points`.
  [[nodiscard]] static Schedule ramp(double from, double to, double start, double end);
  /// Makes the schedule of the points (times[i], values[i]). Throws ConfigError with `broken_rule`.
  [[nodiscard]] static Schedule points(ScheduleKind kind, std::vector<double> times,
                                       std::vector<double> values);
  /// Returns the rule that points break, as in "must have ascending times"; empty when nothing is.
  [[nodiscard]] static std::string_view broken_rule(std::span<const double> times,
                                                    std::span<const double> values);

  /// Returns the value at a time.
  [[nodiscard]] double value(double time) const;
  /// Returns the derivative in time at a time; 0 in stages.
  [[nodiscard]] double rate(double time) const;
  [[nodiscard]] double first() const { return values_.front(); }
  [[nodiscard]] double last() const { return values_.back(); }

  [[nodiscard]] bool is_constant() const;
  /// Returns the first time after `time` at which it has a kink or jumps; infinity when there is
  /// none.
  [[nodiscard]] double next_kink(double time) const;
  /// Tells whether the value jumps at `time`.
  [[nodiscard]] bool jumps_at(double time) const;
  /// Returns the time of the last kink or jump; minus infinity for a constant.
  [[nodiscard]] double rests_after() const;

  [[nodiscard]] ScheduleKind kind() const { return kind_; }
  /// Returns the times of the points, as many as `values()`. A constant has no times and one value.
  [[nodiscard]] std::span<const double> times() const { return times_; }
  [[nodiscard]] std::span<const double> values() const { return values_; }

  /// Returns the schedule with its values multiplied by `factor`, at the same times.
  [[nodiscard]] Schedule scaled(double factor) const;
  /// Returns the schedule with other values, as many as before, at the same times.
  [[nodiscard]] Schedule with_values(std::vector<double> values) const;

  friend bool operator==(const Schedule&, const Schedule&) = default;

 private:
  [[nodiscard]] std::size_t piece(double time) const;

  ScheduleKind kind_ = ScheduleKind::linear;
  std::vector<double> times_;
  std::vector<double> values_;
};

/// Returns the text of a schedule as in a case file: `5`, `[5, 4, 0, 1]` or `{ times = [0, 1, 2],
/// values = [5, 4, 4.5], kind = "linear" }`.
[[nodiscard]] std::string text_of(const Schedule& schedule);

}  // namespace vesica::model

namespace vesica {
template <>
struct EnumNames<model::ScheduleKind> {
  static constexpr std::array<std::pair<model::ScheduleKind, std::string_view>, 2> names{
      {{model::ScheduleKind::linear, "linear"}, {model::ScheduleKind::stages, "stages"}}};
};
}  // namespace vesica
