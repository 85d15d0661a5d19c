#pragma once

#include <string_view>

#include "vesica/adapt/size_field.hpp"

namespace vesica::adapt {

/// Throws ConfigError, with the name of the caller, when an array has not one row for each node or
/// is not finite. The order parameter may have no entries.
void check_nodal_fields(std::string_view caller, const mesh::Surface& surface,
                        const fem::NodalShapeOperator& shape_operator,
                        const PhaseInterface& phases);

}  // namespace vesica::adapt
