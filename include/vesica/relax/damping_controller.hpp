#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "vesica/core/fields.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// How the damping is chosen. speed: alpha = gain / ||v_nu||; ratio: keep ||v_tau|| / ||v_nu||
/// within [lower_ratio, upper_ratio] (3.4); paper: the same rule with the constants of the paper;
/// fixed: alpha = initial.
enum class DampingKind { speed, ratio, paper, fixed };

}  // namespace vesica::relax

namespace vesica {
template <>
struct EnumNames<relax::DampingKind> {
  using enum relax::DampingKind;
  static constexpr std::array<std::pair<relax::DampingKind, std::string_view>, 4> names{
      {{speed, "speed"}, {ratio, "ratio"}, {paper, "paper"}, {fixed, "fixed"}}};
};
}  // namespace vesica

namespace vesica::relax {

/// Options of the tangential damping alpha of (3.4). alpha is measured in R_c^2/k_kappa. What is
/// not given takes the default of its kind (`resolved_damping`).
struct DampingOptions {
  DampingKind kind = DampingKind::speed;
  std::optional<double> initial;
  std::optional<double> minimum;
  std::optional<double> maximum;
  std::optional<double> factor;
  double gain = 5;
  double lower_ratio = 0.1;
  double upper_ratio = 0.5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum DampingKind;
    constexpr Users all_but_fixed(speed, ratio, paper);
    visit(
        Field{
            "kind", "-",
            "speed (alpha = gain/||v_nu||), ratio (3.4), paper (3.4 with its constants) or fixed"},
        self.kind);
    visit(Field{"initial", "R_c^2/k", "start value; default 1 (paper: 1e-4)", Rule::positive},
          self.initial);
    visit(Field{"minimum", "R_c^2/k", "lower limit; default 1e-2 (paper: 1e-6)", Rule::positive,
                all_but_fixed},
          self.minimum);
    visit(Field{"maximum", "R_c^2/k", "upper limit; default 10 (paper: 1e4)", Rule::positive,
                all_but_fixed},
          self.maximum);
    visit(Field{"factor", "-", "largest change in a step; default 2 (paper: 10)",
                Rule::at_least_one, all_but_fixed},
          self.factor);
    visit(Field{"gain", "-", "alpha times ||v_nu||", Rule::positive, Users(speed)}, self.gain);
    visit(Field{"lower_ratio", "-", "c_v of (3.4): below it the damping is lowered", Rule::positive,
                Users(ratio, paper)},
          self.lower_ratio);
    visit(Field{"upper_ratio", "-", "C_v of (3.4): above it the damping is raised", Rule::positive,
                Users(ratio, paper)},
          self.upper_ratio);
  }
  /// Throws ConfigError for limits and ratios in the wrong order, and a start outside of the
  /// limits.
  void check_together() const;
};

/// Returns the options with every default of their kind filled in. Throws ConfigError as `check`,
/// and when minimum > maximum, initial lies outside of them, or lower_ratio >= upper_ratio.
[[nodiscard]] DampingOptions resolved_damping(const DampingOptions& options);

/// Chooses alpha between steps from the velocity norms.
class DampingController final : public Controller {
 public:
  /// Makes the controller. The `scales` of the case give the units in which the options are meant.
  DampingController(const DampingOptions& options, const problem::Scales& scales);
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;

 private:
  DampingOptions options_;
  problem::Scales scales_;
};

}  // namespace vesica::relax
