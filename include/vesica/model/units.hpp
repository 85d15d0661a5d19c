#pragma once

#include <string_view>

#include "vesica/model/model.hpp"

namespace vesica::model {

/// Units of length and energy, as multiples of those of a case.
struct Units {
  double length = 1;
  double energy = 1;

  /// Returns the unit of time, length^4/energy.
  [[nodiscard]] double time() const { return length * length * length * length / energy; }
  /// Returns the unit that the text of a Field names: "length", "energy" or "time" with a
  /// power, or a quotient of two of these, as in "energy/length^2" or "1/length". Pure numbers, "-" and what is
  /// measured in R_c or k already, have the unit 1. Throws std::logic_error for other texts.
  [[nodiscard]] double of(std::string_view unit) const;
  [[nodiscard]] Units inverse() const { return {1 / length, 1 / energy}; }
  friend bool operator==(const Units&, const Units&) = default;
};

/// Returns the model with its material, its targets and the times of its schedules in other units.
/// With units that are powers of two nothing is rounded.
[[nodiscard]] Model in_units(const Model& model, const Units& units);

}  // namespace vesica::model
