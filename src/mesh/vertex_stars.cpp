#include "vertex_stars.hpp"

#include <numeric>

namespace vesica::mesh {

VertexStars::VertexStars(const Triangulation& triangulation)
    : starts_(static_cast<std::size_t>(triangulation.num_nodes()) + 1),
      triangles_(3 * triangulation.triangles().size()) {
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) ++starts_[static_cast<std::size_t>(nodes[i]) + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t t = 0; t < triangulation.triangles().size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto node = static_cast<std::size_t>(triangulation.triangles()[t][i]);
      triangles_[next[node]++] = static_cast<NodeIndex>(t);
    }
  }
}

}  // namespace vesica::mesh
