#include "nodal_fields.hpp"

#include <fmt/format.h>

#include "vesica/core/error.hpp"

namespace vesica::adapt {

void check_nodal_fields(std::string_view caller, const mesh::Surface& surface,
                        const fem::NodalShapeOperator& shape_operator,
                        const PhaseInterface& phases) {
  const mesh::NodeIndex num_nodes = surface.triangulation->num_nodes();
  const auto check = [&](const auto& field, std::string_view name) {
    if (field.rows() != num_nodes) {
      throw ConfigError(fmt::format("{}: {} has {} rows: must have one for each of the {} nodes",
                                    caller, name, field.rows(), num_nodes));
    }
    if (!field.allFinite()) throw ConfigError(fmt::format("{}: {}: must be finite", caller, name));
  };
  check(surface.positions, "positions");
  check(shape_operator, "shape_operator");
  if (phases.order_parameter.size() > 0) check(phases.order_parameter, "order_parameter");
}

}  // namespace vesica::adapt
