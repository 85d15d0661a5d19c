#pragma once

#include <Eigen/Core>

#include "vesica/adapt/remeshed.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::adapt {

/// Meshes a surface anew with edges about as long as `sizes` [length], one at each node of `old`
/// (positive; see size_field.hpp), for any genus. On the vertex triangulation, 8 times or until
/// edges rest:
///
///     split edges longer than 1.36 L, L the mean size at their ends
///     collapse edges shorter than 0.72 L
///     flip edges towards valence 6
///     smooth: vertices go towards the mean of their triangles' centroids, weighted area / L^4
///
/// then 6 rounds of flips and smoothing that raise the smallest angles. A collapse keeps the
/// topology, no triangle turns over, and every vertex ends at the closest point of the old
/// quadratic surface, on the sheet where it was; mid-edge nodes are the closest points to the
/// middles of the chords. The shape changes by the interpolation error of the new mesh, O(L^3).
///
/// On a smooth surface the quality (3.5) is above 0.5. On one whose neighbouring elements differ by
/// more than 60 degrees in their normals folds may remain: check smallest_normal_cosine.
///
/// Throws ConfigError when `sizes` has another length than the number of nodes or an entry that is
/// not positive and finite, or a position is not finite.
[[nodiscard]] Remeshed local_remesh(const mesh::Surface& old, const Eigen::VectorXd& sizes);

}  // namespace vesica::adapt
