#pragma once

#include <string>

namespace vesica::linalg {

/// Returns the versions of the sparse solvers this library was compiled with, as in "UMFPACK 5.7.9,
/// KLU 1.3.8".
[[nodiscard]] std::string suitesparse_versions();

}  // namespace vesica::linalg
