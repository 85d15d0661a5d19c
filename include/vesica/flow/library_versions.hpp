#pragma once

#include <string>

namespace vesica::flow {

/// Returns the version of SUNDIALS this library was compiled with, "major.minor.patch".
[[nodiscard]] std::string sundials_version();

}  // namespace vesica::flow
