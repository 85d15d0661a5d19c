#pragma once

#include <fmt/format.h>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "config/case_document.hpp"
#include "config/nearest_name.hpp"
#include "vesica/core/fields.hpp"
#include "vesica/model/constraints.hpp"
#include "vesica/model/material.hpp"
#include "vesica/solve/time_step.hpp"

/// How the types of options stand in a case file: `assign` reads, without regard to rules, and
/// `toml_text` writes.
namespace vesica::config {

void assign(const Entry& entry, bool& target);
void assign(const Entry& entry, int& target);
void assign(const Entry& entry, double& target);
void assign(const Entry& entry, std::string& target);
void assign(const Entry& entry, Eigen::Vector3d& target);
void assign(const Entry& entry, std::vector<Eigen::Vector3d>& target);
/// A number, [from, to, t0, t1] or { times = [...], values = [...], kind = "linear" or "stages" }.
void assign(const Entry& entry, model::Schedule& target);
/// An array of two schedules, or one for both phases.
void assign(const Entry& entry, model::PhaseSchedules& target);
/// A schedule, whose first value may be "initial", or "initial" or "free".
void assign(const Entry& entry, model::Target& target);
/// A number or "(eps/30)^2".
void assign(const Entry& entry, solve::TimeStep& target);

[[nodiscard]] std::string toml_text(bool value);
[[nodiscard]] std::string toml_text(int value);
[[nodiscard]] std::string toml_text(double value);
[[nodiscard]] std::string toml_text(const std::string& value);
[[nodiscard]] std::string toml_text(const Eigen::Vector3d& value);
[[nodiscard]] std::string toml_text(const std::vector<Eigen::Vector3d>& value);
[[nodiscard]] std::string toml_text(const model::Schedule& value);
[[nodiscard]] std::string toml_text(const model::PhaseSchedules& value);
[[nodiscard]] std::string toml_text(const model::Target& value);
[[nodiscard]] std::string toml_text(const solve::TimeStep& value);

template <class E>
[[nodiscard]] std::vector<std::string> enum_names() {
  std::vector<std::string> names;
  for (const auto& [value, name] : EnumNames<E>::names) names.emplace_back(name);
  return names;
}

/// The value of `names` that the entry holds; throws ConfigError with the list and the nearest
/// name.
[[nodiscard]] std::size_t index_of_name(const Entry& entry, const std::vector<std::string>& names);

template <class E>
requires std::is_enum_v<E>
void assign(const Entry& entry, E& target) {
  target = EnumNames<E>::names[index_of_name(entry, enum_names<E>())].first;
}

template <class E>
requires std::is_enum_v<E>
[[nodiscard]] std::string toml_text(E value) { return fmt::format("\"{}\"", name_of(value)); }

template <class T>
void assign(const Entry& entry, std::optional<T>& target) {
  T value{};
  assign(entry, value);
  target = std::move(value);
}

}  // namespace vesica::config
