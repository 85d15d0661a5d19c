#include "vesica/flow/library_versions.hpp"

#include <sundials/sundials_config.h>

namespace vesica::flow {

std::string sundials_version() { return SUNDIALS_VERSION; }

}  // namespace vesica::flow
