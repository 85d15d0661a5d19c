#pragma once

#include <optional>

#include "vesica/adapt/remeshed.hpp"
#include "vesica/adapt/size_field.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/mesh/triangulation.hpp"
#include "vesica/paper/bisection.hpp"

namespace vesica::paper {

/// Meshes a surface anew by Section 3.6: a mesh of the unit sphere is laid on it by the inverse of
/// its conformal map, so it keeps its angles. Sizes are what the map makes of them, so the
/// sphere mesh (an icosahedron to begin with) is bisected where its image has elements larger than
/// wanted, wanted_diameters with the fields of the old nodes, until there are none or `max_nodes`
/// nodes are reached. All nodes are points of the old quadratic surface, mid-edge nodes the closest
/// ones to the middles of the chords.
///
/// Absent when the map turns triangles over. Throws ConfigError when the surface is not of genus 0.
[[nodiscard]] std::optional<adapt::Remeshed> conformal_remesh(
    const mesh::Surface& old, const fem::NodalShapeOperator& shape_operator,
    const adapt::PhaseInterface& phases, const BisectionOptions& options, double max_nodes);

}  // namespace vesica::paper
