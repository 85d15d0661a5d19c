#include "vesica/mesh/edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "vesica/core/error.hpp"

namespace vesica::mesh {
namespace {

Edge edge_of(const Corners& corners, std::size_t side) {
  const auto [low, high] = std::minmax(corners[side], corners[(side + 1) % 3]);
  return {low, high};
}

void check_corners(std::span<const Corners> triangles, NodeIndex num_vertices) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const NodeIndex node : triangles[t]) {
      if (node < 0 || node >= num_vertices) {
        throw ConfigError(fmt::format("triangulation: triangle {} has node {}: must be in [0, {})",
                                      t, node, num_vertices));
      }
    }
  }
}

}  // namespace

QuadraticConnectivity add_edge_nodes(std::span<const Corners> triangles, NodeIndex num_vertices) {
  check_corners(triangles, num_vertices);
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Corners& corners : triangles) {
    for (std::size_t side = 0; side < 3; ++side) edges.push_back(edge_of(corners, side));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  QuadraticConnectivity result;
  result.triangles.reserve(triangles.size());
  for (const Corners& corners : triangles) {
    QuadraticTriangle nodes{corners[0], corners[1], corners[2]};
    for (std::size_t side = 0; side < 3; ++side) {
      const auto found = std::lower_bound(edges.begin(), edges.end(), edge_of(corners, side));
      nodes[3 + side] = num_vertices + static_cast<NodeIndex>(found - edges.begin());
    }
    result.triangles.push_back(nodes);
  }
  result.edges = std::move(edges);
  return result;
}

}  // namespace vesica::mesh
