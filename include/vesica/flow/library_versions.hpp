#pragma once

#include <string>

namespace vesica::flow {

/// Version of SUNDIALS this library was compiled with, "major.minor.patch".
[[nodiscard]] std::string sundials_version();

}  // namespace vesica::flow
