#pragma once

#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {

/// Throws ConfigError when a key that the shape's kind reads has a value that makes no shape, or
/// when the shape would have more than 20 million nodes.
void check_options(const ShapeOptions& options);

/// Cubes glued for a capsule or peanut, round(length / diameter).
[[nodiscard]] int number_of_cubes(const ShapeOptions& options);

}  // namespace vesica::shapes
