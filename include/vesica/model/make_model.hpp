#pragma once

#include "vesica/model/constraints.hpp"
#include "vesica/model/material.hpp"
#include "vesica/model/model.hpp"

namespace vesica::model {

/// Makes the targets of the constraints from the options: resolves "initial" with `start` and
/// reduced numbers with the area target. `start` is what the start has. A phase target that needs a
/// phase field not yet made (`start` has none) stays absent. Throws ConfigError for targets that no
/// surface satisfies: reduced volume above 1, |A_1 - A_2| above the area, a quantity given twice, a
/// phase target for a single-phase vesicle.
[[nodiscard]] Targets make_targets(const ConstraintOptions& options, const Measures& start,
                                   bool is_two_phase);

/// Returns the material in the units of the case. Reduced numbers (`reduced_line_tension`,
/// `rigidity_ratio`, `saddle_splay_difference`) are resolved with R_c of `area`. Throws ConfigError
/// for a quantity given twice or out of its range.
[[nodiscard]] MaterialOptions resolved_material(const MaterialOptions& options, double area);

}  // namespace vesica::model
