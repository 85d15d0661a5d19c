#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "vesica/config/config.hpp"
#include "vesica/core/check.hpp"

namespace vesica::config {
namespace {

template <class T>
bool changes_in_time(const T& value) {
  if constexpr (std::is_same_v<T, model::Schedule>) {
    return !value.is_constant();
  } else if constexpr (requires { value.has_value(); }) {
    return value && changes_in_time(*value);
  } else if constexpr (requires { value.parts(); }) {
    return changes_in_time(value.parts());
  } else if constexpr (requires { value.begin(); }) {
    return std::any_of(value.begin(), value.end(),
                       [](const auto& part) { return changes_in_time(part); });
  } else {
    return false;
  }
}

/// Returns "table.key" of the first option for which `holds(field, value)`; empty when there is
/// none.
template <class Options, class Holds>
std::string first_key(std::string_view table, const Options& options, const Holds& holds) {
  std::string found;
  Options::fields(options, [&](const Field& field, const auto& value) {
    if (found.empty() && holds(field, value)) found = fmt::format("{}.{}", table, field.name);
  });
  return found;
}

/// Returns "table.key" of the first option that differs from that of `usual` and that IDA uses but
/// not minimisation; empty when there is none.
template <class Options>
std::string first_of_flow(std::string_view table, const Options& options, const Options& usual,
                          bool flow_uses_all) {
  using enum solve::Method;
  std::string found;
  for_each_changed(options, usual, [&](const Field& field, const auto&) {
    const bool is_of_flow =
        flow_uses_all || (field.used_by.include(ida) && !field.used_by.include(minimize));
    if (found.empty() && is_of_flow) found = fmt::format("{}.{}", table, field.name);
  });
  return found;
}

std::string schedule_of(const RunConfig& config) {
  const auto changes = [](const Field&, const auto& value) { return changes_in_time(value); };
  const std::string key = first_key("material", config.material, changes);
  return key.empty() ? first_key("constraints", config.constraints, changes) : key;
}

std::string option_of_flow(const RunConfig& config) {
  RunConfig usual;
  apply_accuracy(config.accuracy, usual);
  std::string key = first_of_flow("solver", config.solver, usual.solver, false);
  if (key.empty()) key = first_of_flow("stop", config.stop, usual.stop, false);
  return key.empty() ? first_of_flow("damping", config.damping, usual.damping, true) : key;
}

}  // namespace

void apply_accuracy(Accuracy accuracy, RunConfig& config) {
  if (accuracy == Accuracy::draft) {
    config.solver.rtol = 1e-2;
    config.stop.normal_velocity = 1e-2;
  } else if (accuracy == Accuracy::reference) {
    config.solver.rtol = 1e-5;
    config.stop.normal_velocity = 1e-4;
  }
}

MethodChoice choose_method(const RunConfig& config) {
  using solve::Method;
  if (config.solver.method != Method::automatic) return {config.solver.method, "the case names it"};
  if (config.stop.end_time < std::numeric_limits<double>::infinity())
    return {Method::ida, "stop.end_time is a time of the flow"};
  if (const std::string key = schedule_of(config); !key.empty())
    return {Method::ida, fmt::format("{} changes in time", key)};
  if (const std::string key = option_of_flow(config); !key.empty())
    return {Method::ida, fmt::format("{} is an option of the flow", key)};
  if (config.adaption.enabled && config.adaption.method != relax::MeshMethod::local) {
    return {Method::ida,
            fmt::format("adaption.method = {} needs it", name_of(config.adaption.method))};
  }
  return {Method::minimize, "an equilibrium is wanted"};
}

RunConfig resolved(RunConfig config) {
  config.solver.method = choose_method(config).method;
  return config;
}

}  // namespace vesica::config
