#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "vesica/core/fields.hpp"

namespace vesica {

/// Returns the text of a rule, as in "must be > 0".
[[nodiscard]] std::string rule_text(const Rule& rule);

/// Returns the text of the rule that one of the numbers breaks; empty when none does.
[[nodiscard]] std::string broken_rule(const Rule& rule, std::span<const double> numbers);

/// Returns `1.5` for one number and `[1, 2, 3]` for several.
[[nodiscard]] std::string text_of(std::span<const double> numbers);

/// Throws ConfigError `table.key = value: rule`.
[[noreturn]] void refuse_option(std::string_view table, std::string_view key,
                                std::string_view value, std::string_view rule);

/// Calls refuse(text, rule) for the first part of an option's value that breaks the rule. Numbers
/// and arrays of them are their own part, and types with `values()`, their numbers, and a
/// `text_of`; a type with `parts()` is checked by what that returns, an array element by element.
template <class T, class Refuse>
void check_value(const Rule& rule, const T& value, const Refuse& refuse) {
  const auto check_numbers = [&](std::span<const double> numbers, const auto& part) {
    const std::string broken = broken_rule(rule, numbers);
    if (!broken.empty()) refuse(text_of(part), broken);
  };
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return;
  } else if constexpr (std::is_arithmetic_v<T>) {
    const double number = value;
    const std::span<const double> numbers(&number, 1);
    check_numbers(numbers, numbers);
  } else if constexpr (requires { value.has_value(); }) {
    if (value) check_value(rule, *value, refuse);
  } else if constexpr (requires { value.parts(); }) {
    check_value(rule, value.parts(), refuse);
  } else if constexpr (requires { value.values(); }) {
    check_numbers(value.values(), value);
  } else if constexpr (std::is_same_v<typename T::value_type, double>) {
    const std::span<const double> numbers(value.data(), static_cast<std::size_t>(value.size()));
    check_numbers(numbers, numbers);
  } else {
    for (const auto& part : value) check_value(rule, part, refuse);
  }
}

/// Refuses options that break the rule of a field, or of several together. `table` is their name in
/// a case file. Fields that the alternatives, if given, do not use are left out. Throws
/// ConfigError, `solver.rtol = -1: must be > 0`. Every function of the library that takes options
/// calls it, and so does the reader of case files.
template <class Options, class... Alternative>
void check(std::string_view table, const Options& options, Alternative... chosen) {
  Options::fields(options, [&](const Field& field, const auto& value) {
    if (!(field.used_by.include(chosen) && ...)) return;
    check_value(field.rule, value, [&](std::string_view text, std::string_view rule) {
      refuse_option(table, field.name, text, rule);
    });
  });
  if constexpr (requires { options.check_together(); }) options.check_together();
}

/// Returns the options after `check`.
template <class Options>
[[nodiscard]] const Options& checked(std::string_view table, const Options& options) {
  check(table, options);
  return options;
}

/// Calls visit(field, value) for the fields that differ from those of `usual`.
template <class Options, class Visit>
void for_each_changed(const Options& options, const Options& usual, const Visit& visit) {
  std::vector<const void*> values;
  Options::fields(usual, [&](const Field&, const auto& value) { values.push_back(&value); });
  std::size_t i = 0;
  Options::fields(options, [&]<class T>(const Field& field, const T& value) {
    if (!(value == *static_cast<const T*>(values[i++]))) visit(field, value);
  });
}

/// Calls visit(field, value) for the fields that differ from their defaults but are not used by the
/// alternative.
template <class Options, class Alternative, class Visit>
void for_each_unused(const Options& options, Alternative chosen, const Visit& visit) {
  for_each_changed(options, Options{}, [&](const Field& field, const auto& value) {
    if (!field.used_by.include(chosen)) visit(field, value);
  });
}

}  // namespace vesica
