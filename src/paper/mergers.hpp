#pragma once

#include <array>
#include <span>
#include <vector>

#include "bisected_edges.hpp"
#include "vesica/paper/bisection.hpp"

namespace vesica::paper {

/// Two pairs of neighbouring triangles around one vertex that become two triangles. The first of a
/// pair is the place of its parent in the list.
struct Merger {
  std::array<std::array<mesh::NodeIndex, 2>, 2> children;
  std::array<mesh::QuadraticTriangle, 2> parents;
};

/// The bisections that can be undone together: all four triangles at a vertex have it as their
/// newest (corner 2), are marked for coarsening and keep their edges, the merged ones are fit (see
/// bisect), no two vertices become joined twice, and none is left with fewer than three neighbours.
[[nodiscard]] std::vector<Merger> find_mergers(const mesh::Surface& surface,
                                               std::span<const Mark> marks,
                                               const BisectedEdges& edges);

}  // namespace vesica::paper
