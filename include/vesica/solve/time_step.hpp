#pragma once

#include <optional>
#include <string_view>

namespace vesica::solve {

/// Fixed step of the semi-implicit method: a number, or (eps/30)^2 with the interface width eps,
/// the step of Table 1 of the paper; both in the units of the case.
struct TimeStep {
  static constexpr std::string_view from_interface_width = "(eps/30)^2";  ///< as in a case file

  std::optional<double> value;  ///< [length^4/energy]; absent: (eps/30)^2

  /// Returns the step [length^4/energy] for an interface width [length].
  [[nodiscard]] double resolved(double interface_width) const {
    return value.value_or(interface_width * interface_width / 900);
  }
  [[nodiscard]] const std::optional<double>& parts() const { return value; }
  friend bool operator==(const TimeStep&, const TimeStep&) = default;
};

}  // namespace vesica::solve
