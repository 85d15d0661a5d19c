#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "vesica/core/error.hpp"
#include "vesica/model/make_model.hpp"

namespace vesica::model {
namespace {

template <class T>
[[noreturn]] void refuse(std::string_view key, const T& value, std::string_view rule) {
  throw ConfigError(fmt::format("material.{} = {}: {}", key, value, rule));
}

/// Checks every field against the rule it declares.
struct CheckRules {
  void operator()(const Field& field, double value) const {
    if (!std::isfinite(value)) refuse(field.name, value, "must be finite");
    if (!satisfies(field.rule, value)) refuse(field.name, value, rule_text(field.rule));
  }
  void operator()(const Field& field, const Schedule& schedule) const {
    for (const double value : schedule.values()) (*this)(field, value);
  }
  void operator()(const Field& field, const PhaseSchedules& pair) const {
    (*this)(field, pair.phase_1);
    (*this)(field, pair.phase_2);
  }
  void operator()(const Field& field, const std::optional<double>& value) const {
    if (value) (*this)(field, *value);
  }
};

void check_given_once(const MaterialOptions& options) {
  const MaterialOptions defaults;
  if (options.reduced_line_tension && options.line_tension != defaults.line_tension) {
    refuse("reduced_line_tension", *options.reduced_line_tension,
           fmt::format("material.line_tension = {} is given too; give one of them",
                       text_of(options.line_tension)));
  }
  if (options.rigidity_ratio &&
      options.bending_rigidity.phase_1 != options.bending_rigidity.phase_2) {
    refuse("rigidity_ratio", *options.rigidity_ratio,
           fmt::format("material.bending_rigidity = [{}, {}] gives the rigidity of phase 2 too; "
                       "give one number for phase 1",
                       text_of(options.bending_rigidity.phase_1),
                       text_of(options.bending_rigidity.phase_2)));
  }
  if (options.saddle_splay_difference && options.gaussian_rigidity != defaults.gaussian_rigidity) {
    refuse("saddle_splay_difference", *options.saddle_splay_difference,
           fmt::format("material.gaussian_rigidity = [{}, {}] is given too; give one of them",
                       text_of(options.gaussian_rigidity.phase_1),
                       text_of(options.gaussian_rigidity.phase_2)));
  }
}

}  // namespace

MaterialOptions resolved_material(const MaterialOptions& options, double area) {
  MaterialOptions::fields(options, CheckRules{});
  check_given_once(options);
  MaterialOptions material = options;
  const Schedule& rigidity = options.bending_rigidity.phase_1;
  if (options.reduced_line_tension) {
    if (!(area > 0) || !std::isfinite(area)) {
      refuse("reduced_line_tension", *options.reduced_line_tension,
             fmt::format("needs a surface area > 0, not {}", area));
    }
    const double characteristic_radius = std::sqrt(area / (4 * std::numbers::pi));
    material.line_tension =
        rigidity.scaled(0.75 * *options.reduced_line_tension / characteristic_radius);
  }
  if (options.rigidity_ratio) {
    material.bending_rigidity.phase_2 = rigidity.scaled(*options.rigidity_ratio);
  }
  if (options.saddle_splay_difference) {
    material.gaussian_rigidity = {rigidity.scaled(*options.saddle_splay_difference), 0};
  }
  material.reduced_line_tension.reset();
  material.rigidity_ratio.reset();
  material.saddle_splay_difference.reset();
  return material;
}

}  // namespace vesica::model
