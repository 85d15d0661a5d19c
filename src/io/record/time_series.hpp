#pragma once

#include <vector>

#include "io/numbers.hpp"
#include "vesica/relax/observer.hpp"

namespace vesica::io {

/// Returns what is recorded after a step, each number with the name of its column in `/series`.
[[nodiscard]] std::vector<Number> series_row(const relax::StepView& view);

}  // namespace vesica::io
