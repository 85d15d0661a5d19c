#pragma once

#include <string_view>
#include <vector>

#include "vesica/relax/observer.hpp"

namespace vesica::io {

/// Names of the quantities recorded after every step, in the order of `series_row`.
[[nodiscard]] std::vector<std::string_view> series_names();

/// Their values; NaN for what does not exist in the model.
[[nodiscard]] std::vector<double> series_row(const relax::StepView& view);

}  // namespace vesica::io
