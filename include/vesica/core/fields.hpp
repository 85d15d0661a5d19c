#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace vesica {

/// What a value of an options field has to satisfy; checked when a case is read, quoted in the
/// message.
enum class Rule { any, positive, non_negative, at_least_one, fraction };

/// Describes one field of an options struct. Every options struct has one static function
///
///     template <class Self, class Visitor> static void fields(Self& self, Visitor&& visit) {
///       visit(Field{"length", "length", "total length along the axis", Rule::positive},
///       self.length);
///     }
///
/// and reading, validation, the template file, the echo of the effective configuration and the HDF5
/// attributes are visitors of it. Adding an option is a member with its default and one such line.
struct Field {
  std::string_view name;     ///< key in the case file, full words
  std::string_view unit;     ///< "length", "energy", "1/length", "time", "-" for pure numbers
  std::string_view meaning;  ///< one line for the template; may name the alternatives
  Rule rule = Rule::any;
};

/// Text of a rule, as in "must be > 0".
[[nodiscard]] constexpr std::string_view rule_text(Rule rule) {
  switch (rule) {
    case Rule::positive:
      return "must be > 0";
    case Rule::non_negative:
      return "must be >= 0";
    case Rule::at_least_one:
      return "must be >= 1";
    case Rule::fraction:
      return "must be between 0 and 1";
    case Rule::any:
      break;
  }
  return "must be a number";
}

/// True when `value` satisfies `rule`; NaN satisfies none.
[[nodiscard]] constexpr bool satisfies(Rule rule, double value) {
  if (value != value) return false;
  switch (rule) {
    case Rule::positive:
      return value > 0;
    case Rule::non_negative:
      return value >= 0;
    case Rule::at_least_one:
      return value >= 1;
    case Rule::fraction:
      return value >= 0 && value <= 1;
    case Rule::any:
      break;
  }
  return true;
}

/// Names of the values of an enumeration as they stand in a case file. Specialise with
/// `static constexpr std::array<std::pair<E, std::string_view>, n> names`.
template <class E>
struct EnumNames;

template <class E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
  for (const auto& [candidate, name] : EnumNames<E>::names) {
    if (candidate == value) return name;
  }
  return "?";
}

}  // namespace vesica
