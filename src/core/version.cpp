#include "vesica/core/version.hpp"

namespace vesica {

std::string_view version() { return VESICA_VERSION; }

}  // namespace vesica
