#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

#include "vesica/core/fields.hpp"
#include "vesica/model/terms.hpp"

namespace vesica::model {

/// One value for each term of a list, in the order of the list.
template <class List, class Value>
struct PerTerm {
  std::array<Value, std::tuple_size_v<List>> values{};

  /// Returns the value of one term, as in `multipliers.of<Volume>()`.
  template <class Term>
  [[nodiscard]] Value& of() {
    static_assert(place_of<List, Term> < std::tuple_size_v<List>, "no term of this list");
    return values[place_of<List, Term>];
  }
  template <class Term>
  [[nodiscard]] const Value& of() const {
    static_assert(place_of<List, Term> < std::tuple_size_v<List>, "no term of this list");
    return values[place_of<List, Term>];
  }
  [[nodiscard]] Value& operator[](std::size_t place) { return values[place]; }
  [[nodiscard]] const Value& operator[](std::size_t place) const { return values[place]; }

  /// Visits the values under the names of their terms, as the fields of options are visited.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    for_each_term<List>([&]<class Term>(std::size_t place) {
      visit(Field{Term::name, "", Term::name}, self.values[place]);
    });
  }
};

/// Energy by parts [energy]; a term that takes no part is absent. The Gaussian part is the one of
/// (1.6), int k_g(c) g with g = (kappa^2 - |Q|^2)/2; (4.3) lacks the factor 1/2.
struct EnergyParts : PerTerm<Energies, std::optional<double>> {
  /// Returns the sum of the parts; NaN when there is none.
  [[nodiscard]] double total() const {
    double sum = 0;
    bool is_known = false;
    for (const auto& part : values) {
      sum += part.value_or(0.0);
      is_known = is_known || part;
    }
    return is_known ? sum : std::numeric_limits<double>::quiet_NaN();
  }
};

/// One value for each constraint, absent for a constraint that is left free. Multipliers have the
/// signs of (1.7a), so that dF/dV = -volume; that of the volume is in [energy/length^3], those of
/// area and phase in [energy/length^2]. Relative errors are kept in it too.
using PerConstraint = PerTerm<Constraints, std::optional<double>>;

/// Values of the constrained functionals; the phase difference is absent without a phase field.
struct Measures : PerTerm<Constraints, std::optional<double>> {
  /// Returns the enclosed volume [length^3].
  [[nodiscard]] double volume() const { return *of<Volume>(); }
  /// Returns the area of the surface [length^2].
  [[nodiscard]] double area() const { return *of<Area>(); }
  /// Returns int h(c) [length^2], which tends to A_1 - A_2.
  [[nodiscard]] const std::optional<double>& phase_difference() const {
    return of<PhaseDifference>();
  }

  /// Visits the values under the keys that the quantities have in a case file.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    for_each_term<Constraints>([&]<class Constraint>(std::size_t place) {
      visit(Field{Constraint::key, Constraint::unit, Constraint::key}, self.values[place]);
    });
  }
};

}  // namespace vesica::model
