#include "vesica/model/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vesica::model {
namespace {

/// One factor, "length^3" for example.
double power_of(const Units& units, std::string_view factor, std::string_view text) {
  const auto caret = factor.find('^');
  const std::string_view name = factor.substr(0, caret);
  const int power = caret == std::string_view::npos ? 1 : factor[caret + 1] - '0';
  if (name == "1") return 1;
  if (name == "length") return std::pow(units.length, power);
  if (name == "energy") return std::pow(units.energy, power);
  if (name == "time") return std::pow(units.time(), power);
  throw std::logic_error(fmt::format("unit \"{}\": unknown", text));
}

Schedule in_units(const Schedule& schedule, double value, double time) {
  if (schedule.is_constant()) return schedule.first() / value;
  std::vector<double> times(schedule.times().begin(), schedule.times().end());
  std::vector<double> values(schedule.values().begin(), schedule.values().end());
  for (double& t : times) t /= time;
  for (double& v : values) v /= value;
  return Schedule::points(schedule.kind(), std::move(times), std::move(values));
}

struct Convert {
  const Units& units;

  void operator()(const Field& field, Schedule& schedule) const {
    schedule = in_units(schedule, units.of(field.unit), units.time());
  }
  void operator()(const Field& field, PhaseSchedules& pair) const {
    (*this)(field, pair.phase_1);
    (*this)(field, pair.phase_2);
  }
  void operator()(const Field&, const std::optional<double>&) const {}
};

}  // namespace

double Units::of(std::string_view unit) const {
  if (unit == "-" || unit.find("R_c") != std::string_view::npos) return 1;
  const auto slash = unit.find('/');
  const double numerator = power_of(*this, unit.substr(0, slash), unit);
  if (slash == std::string_view::npos) return numerator;
  return numerator / power_of(*this, unit.substr(slash + 1), unit);
}

Model in_units(const Model& model, const Units& units) {
  Model result = model;
  MaterialOptions::fields(result.material, Convert{units});
  for_each_term<Constraints>([&]<class Constraint>(std::size_t place) {
    auto& target = result.targets[place];
    if (target) {
      target = in_units(*target, std::pow(units.length, Constraint::length_power), units.time());
    }
  });
  return result;
}

}  // namespace vesica::model
