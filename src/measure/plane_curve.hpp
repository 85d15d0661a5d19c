#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "loop_tree.hpp"

namespace vesica::measure {

/// A closed curve in a plane.
struct PlaneCurve {
  double length = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// The shortest of the curves in which planes parallel to that of a closed polygon of nodes
/// (through their centre, across their area vector) cut the sub-triangles, going downhill from the
/// polygon in steps of 1/24 of its length. Curves begin at edges of the `nearby` nodes. Absent when
/// the polygon has no plane or is not near a curve of up to its length.
[[nodiscard]] std::optional<PlaneCurve> narrowest_plane_curve(
    const FlatTriangulation& flat, const NodeEdges& edges_at, const mesh::Positions& positions,
    std::span<const mesh::NodeIndex> loop, std::span<const mesh::NodeIndex> nearby);

}  // namespace vesica::measure
