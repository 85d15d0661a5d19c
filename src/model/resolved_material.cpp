#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "core/refuse.hpp"
#include "vesica/core/check.hpp"
#include "vesica/model/make_model.hpp"

namespace vesica::model {

void MaterialOptions::check_together() const {
  const MaterialOptions defaults;
  if (reduced_line_tension && line_tension != defaults.line_tension) {
    refuse("material.reduced_line_tension", *reduced_line_tension,
           fmt::format("material.line_tension = {} is given too; give one of them",
                       text_of(line_tension)));
  }
  if (rigidity_ratio && bending_rigidity.phase_1 != bending_rigidity.phase_2) {
    refuse("material.rigidity_ratio", *rigidity_ratio,
           fmt::format("material.bending_rigidity = [{}, {}] gives the rigidity of phase 2 too; "
                       "give one number for phase 1",
                       text_of(bending_rigidity.phase_1), text_of(bending_rigidity.phase_2)));
  }
  if (saddle_splay_difference && gaussian_rigidity != defaults.gaussian_rigidity) {
    refuse("material.saddle_splay_difference", *saddle_splay_difference,
           fmt::format("material.gaussian_rigidity = [{}, {}] is given too; give one of them",
                       text_of(gaussian_rigidity.phase_1), text_of(gaussian_rigidity.phase_2)));
  }
}

MaterialOptions resolved_material(const MaterialOptions& options, double area) {
  check("material", options);
  MaterialOptions material = options;
  const Schedule& rigidity = options.bending_rigidity.phase_1;
  if (options.reduced_line_tension) {
    if (!(area > 0) || !std::isfinite(area)) {
      refuse("material.reduced_line_tension", *options.reduced_line_tension,
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
