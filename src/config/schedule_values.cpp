#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "config/option_values.hpp"

/// Schedules, alone, in pairs and as targets.
namespace vesica::config {
namespace {

constexpr std::string_view one_schedule =
    "must be a number, [from, to, t0, t1] or { times = [...], values = [...], kind = ... }";
constexpr std::string_view two_schedules =
    "must be a number, [from, to, t0, t1], { times = [...], values = [...], kind = ... } or an "
    "array [phase 1, phase 2] of these";
constexpr std::string_view a_target =
    "must be a number, [from, to, t0, t1], { times = [...], values = [...], kind = ... }, "
    "\"initial\" (also as the first value) or \"free\"";
constexpr std::size_t ramp_size = 4;

/// The points of a schedule as they are written; "initial" stands for a first value.
struct Points {
  model::ScheduleKind kind = model::ScheduleKind::linear;
  std::vector<double> times;
  std::vector<double> values;
  bool begins_at_start = false;
};

/// Reads the schedules of one entry.
class ScheduleReader {
 public:
  ScheduleReader(const Entry& entry, std::string_view expected)
      : entry_(entry), expected_(expected) {}

  [[nodiscard]] model::Schedule constant_or_schedule(const toml::node& node) const {
    if (node.is_number()) return number(node);
    const Points read = points(node, false);
    return model::Schedule::points(read.kind, read.times, read.values);
  }

  [[nodiscard]] model::Target target(const toml::node& node) const {
    if (node.is_number()) return {model::TargetKind::prescribed, number(node)};
    const Points read = points(node, true);
    return {model::TargetKind::prescribed,
            model::Schedule::points(read.kind, read.times, read.values), read.begins_at_start};
  }

 private:
  [[nodiscard]] double number(const toml::node& node) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) entry_.refuse(expected_);
    return *value;
  }

  [[nodiscard]] Points points(const toml::node& node, bool may_begin_at_start) const {
    Points result;
    if (const toml::array* ramp = node.as_array()) {
      if (ramp->size() != ramp_size) entry_.refuse(expected_);
      add_value(*ramp->get(0), may_begin_at_start, result);
      add_value(*ramp->get(1), false, result);
      result.times = {number(*ramp->get(2)), number(*ramp->get(3))};
      if (!(result.times[0] < result.times[1])) entry_.refuse("must have t0 < t1");
    } else if (const toml::table* table = node.as_table()) {
      read_table(*table, may_begin_at_start, result);
    } else {
      entry_.refuse(expected_);
    }
    const auto rule = model::Schedule::broken_rule(result.times, result.values);
    if (!rule.empty()) entry_.refuse(rule);
    return result;
  }

  void read_table(const toml::table& table, bool may_begin_at_start, Points& result) const {
    for (const auto& [key, node] : table) {
      const std::string word(key.str());
      if (word == "times") {
        for (const toml::node& time : array(node)) result.times.push_back(number(time));
      } else if (word == "values") {
        for (const toml::node& value : array(node))
          add_value(value, may_begin_at_start && result.values.empty(), result);
      } else if (word == "kind") {
        const Entry kind{entry_.place, entry_.key + ".kind", node};
        assign(kind, result.kind);
      } else {
        const std::vector<std::string> known{"times", "values", "kind"};
        entry_.refuse(fmt::format("unknown key \"{}\"{}", word, suggestion(word, known)));
      }
    }
  }

  [[nodiscard]] const toml::array& array(const toml::node& node) const {
    if (!node.is_array()) entry_.refuse(expected_);
    return *node.as_array();
  }

  void add_value(const toml::node& node, bool may_be_initial, Points& result) const {
    if (may_be_initial && node.value<std::string>() == "initial") {
      result.begins_at_start = true;
      result.values.push_back(0);
      return;
    }
    result.values.push_back(number(node));
  }

  const Entry& entry_;
  std::string_view expected_;
};

/// `first` replaces the text of the first value.
std::string schedule_text(const model::Schedule& schedule,
                          const std::optional<std::string>& first = {}) {
  std::vector<std::string> times;
  std::vector<std::string> values;
  for (const double time : schedule.times()) times.push_back(toml_text(time));
  for (const double value : schedule.values()) values.push_back(toml_text(value));
  if (first) values.front() = *first;
  if (times.empty()) return values.front();
  if (schedule.kind() == model::ScheduleKind::linear && times.size() == 2)
    return fmt::format("[{}, {}]", fmt::join(values, ", "), fmt::join(times, ", "));
  return fmt::format("{{ times = [{}], values = [{}], kind = {} }}", fmt::join(times, ", "),
                     fmt::join(values, ", "), toml_text(schedule.kind()));
}

}  // namespace

void assign(const Entry& entry, model::Schedule& target) {
  target = ScheduleReader(entry, one_schedule).constant_or_schedule(entry.node);
}

void assign(const Entry& entry, model::PhaseSchedules& target) {
  const ScheduleReader reader(entry, two_schedules);
  const toml::array* pair = entry.node.as_array();
  if (pair != nullptr && pair->size() == 2) {
    target = {reader.constant_or_schedule(*pair->get(0)),
              reader.constant_or_schedule(*pair->get(1))};
  } else {
    const auto both = reader.constant_or_schedule(entry.node);
    target = {both, both};
  }
}

void assign(const Entry& entry, model::Target& target) {
  if (entry.node.is_string()) {
    const std::string word = entry.node.value<std::string>().value();
    if (word != "initial" && word != "free") entry.refuse(a_target);
    target = {word == "free" ? model::TargetKind::free : model::TargetKind::initial};
  } else {
    target = ScheduleReader(entry, a_target).target(entry.node);
  }
}

std::string toml_text(const model::Schedule& value) { return schedule_text(value); }

std::string toml_text(const model::PhaseSchedules& value) {
  return fmt::format("[{}, {}]", schedule_text(value.phase_1), schedule_text(value.phase_2));
}

std::string toml_text(const model::Target& value) {
  const std::string initial = "\"initial\"";
  if (value.kind == model::TargetKind::initial) return initial;
  if (value.kind == model::TargetKind::free) return "\"free\"";
  return schedule_text(value.schedule,
                       value.begins_at_start ? std::optional(initial) : std::nullopt);
}

}  // namespace vesica::config
