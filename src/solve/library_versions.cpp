#include "vesica/solve/library_versions.hpp"

#include <sundials/sundials_config.h>

namespace vesica::solve {

std::string sundials_version() { return SUNDIALS_VERSION; }

}  // namespace vesica::solve
