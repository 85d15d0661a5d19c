#pragma once

#include <Eigen/Core>
#include <vector>

#include "vesica/mesh/surface_locator.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// New places for the nodes of a surface, on that surface.
struct Redistribution {
  Positions positions;
  /// Where each node lies on the old surface: SurfaceLocator::interpolate at `origins` carries
  /// nodal fields over.
  std::vector<SurfaceLocation> origins;
};

/// Moves the nodes along the surface, triangles kept, so that elements become alike in size and
/// better in angles. In each of `sweeps` rounds every vertex goes to where the sum of area^2 /
/// size^4 over its flat triangles is small, as long as the quality (3.5) of these does not fall, or
/// stays above 0.5; then mid-edge nodes go to the closest points to the middles of the chords; then
/// four rounds improve the angles where the quality is below 0.5, with moves that raise the lowest
/// quality around the vertex. No triangle is turned over, and all nodes end at closest points of
/// the old quadratic surface. The quality of the mesh does not fall, or stays above 0.5: otherwise
/// the nodes stay where they are.
///
/// `sizes`: wanted element size [length] at each node, or empty for equal sizes. The shape changes
/// by the interpolation error of quadratic elements, O(h^3). Throws ConfigError when `sizes` has
/// another length than the number of nodes or an entry that is not positive.
[[nodiscard]] Redistribution redistribute(const Surface& surface, int sweeps,
                                          const Eigen::VectorXd& sizes = {});

}  // namespace vesica::mesh
