#pragma once

#include <string_view>

namespace vesica {

/// Returns the version of the library that is running, "major.minor.patch".
[[nodiscard]] std::string_view version();

}  // namespace vesica
