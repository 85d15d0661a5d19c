#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

namespace vesica {

/// Names of the values of an enumeration as they stand in a case file. Specialise with
/// `static constexpr std::array<std::pair<E, std::string_view>, n> names`, before the options that
/// name their users by it.
template <class E>
struct EnumNames;

template <class E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
  for (const auto& [candidate, name] : EnumNames<E>::names) {
    if (candidate == value) return name;
  }
  return "?";
}

/// Rule that every number of an options field has to satisfy: it lies between two bounds. NaN
/// breaks every rule, infinity all but those that allow it. `check` refuses what breaks its rule,
/// with the rule in the message.
struct Rule {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool excludes_least = false;
  bool allows_infinity = false;

  static const Rule any, positive, non_negative, at_least_one, fraction, positive_or_infinite;
  [[nodiscard]] static constexpr Rule between(double least, double most) { return {least, most}; }
  friend constexpr bool operator==(const Rule&, const Rule&) = default;
};

inline constexpr Rule Rule::any{};
inline constexpr Rule Rule::positive{.least = 0, .excludes_least = true};
inline constexpr Rule Rule::non_negative{.least = 0};
inline constexpr Rule Rule::at_least_one{.least = 1};
inline constexpr Rule Rule::fraction = Rule::between(0, 1);
inline constexpr Rule Rule::positive_or_infinite{
    .least = 0, .excludes_least = true, .allows_infinity = true};

/// The alternatives that use a field, the kinds of a shape for example, as values of their
/// enumeration: `Users(ShapeKind::capsule, ShapeKind::peanut)`. Empty: all of them do.
class Users {
 public:
  constexpr Users() = default;
  template <class E, std::same_as<E>... Es>
  requires std::is_enum_v<E>
  constexpr explicit Users(E first, Es... others)
      : names_{name_of(first), name_of(others)...}, size_(1 + sizeof...(others)) {}

  [[nodiscard]] constexpr std::span<const std::string_view> names() const {
    return std::span(names_).first(size_);
  }
  template <class E>
  [[nodiscard]] constexpr bool include(E alternative) const {
    return size_ == 0 || std::ranges::count(names(), name_of(alternative)) > 0;
  }

 private:
  std::array<std::string_view, 8> names_{};
  std::size_t size_ = 0;
};

/// Describes one field of an options or a result struct. Each has one static function
///
///     template <class Self, class Visitor> static void fields(Self& self, Visitor&& visit) {
///       visit(Field{"length", "length", "total length along x", Rule::positive,
///                   Users(ShapeKind::capsule, ShapeKind::peanut)}, self.length);
///     }
///
/// and reading, `check`, the template file, the echo of the effective configuration and the HDF5
/// attributes are visitors of it. Adding an option is a member with its default and one such line.
/// Rules between several fields are the struct's `void check_together() const`, which throws.
///
/// Likewise the JSON files, the time series, the printed tables and the comparison visit results.
/// The name of a number is its path in `verdict.json`, "mesh/quality"; the fields of a struct whose
/// name is empty stand beside those of the struct that holds it. A number that is computed from
/// others is visited as a temporary, which readers skip.
struct Field {
  std::string_view name;     ///< key in the case file or path in `verdict.json`, full words
  std::string_view unit;     ///< "length", "energy", "1/length", "time", "-" for pure numbers
  std::string_view meaning;  ///< one line for the template, which prints the users in front of it
  Rule rule{};
  Users used_by{};
};

/// A visitor that does nothing; with it HasFields asks whether a type can be visited.
struct IgnoreField {
  void operator()(const Field&, auto&&) const {}
};

/// True for structs with `fields`.
template <class T>
concept HasFields = requires(T& value) {
  T::fields(value, IgnoreField{});
};

/// Calls `combine(a, b)` with every field `a` of `into` and the same field `b` of `with`.
template <HasFields T, class Combine>
void combine_fields(T& into, const T& with, Combine&& combine) {
  T::fields(into, [&]<class A>(const Field& field, A& a) {
    T::fields(with, [&]<class B>(const Field& other, const B& b) {
      if constexpr (std::is_same_v<A, B>) {
        if (field.name == other.name) combine(a, b);
      }
    });
  });
}

}  // namespace vesica
