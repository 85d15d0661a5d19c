#include "vesica/adapt/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

#include "nodal_fields.hpp"
#include "vesica/core/check.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::adapt {
namespace {

/// Dijkstra's algorithm from all nodes at once, smallest sizes first.
void limit_growth(const mesh::Surface& surface, const fem::NodeGraph& graph, double growth,
                  Eigen::VectorXd& sizes) {
  using Entry = std::pair<double, mesh::NodeIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (mesh::NodeIndex node = 0; node < graph.num_nodes(); ++node) queue.emplace(sizes[node], node);
  while (!queue.empty()) {
    const auto [size, node] = queue.top();
    queue.pop();
    if (size > sizes[node]) continue;
    for (const mesh::NodeIndex other : graph.neighbours(node)) {
      const double distance = (surface.positions.row(node) - surface.positions.row(other)).norm();
      const double limit = size + growth * distance;
      if (limit >= sizes[other]) continue;
      sizes[other] = limit;
      queue.emplace(limit, other);
    }
  }
}

}  // namespace

Eigen::VectorXd size_field(const mesh::Surface& surface, const fem::NodeGraph& graph,
                           const fem::NodalShapeOperator& shape_operator,
                           const PhaseInterface& phases, const SizeFieldOptions& options) {
  const mesh::NodeIndex num_nodes = surface.triangulation->num_nodes();
  check("size_field", options);
  check_nodal_fields("size field", surface, shape_operator, phases);
  Eigen::VectorXd sizes(num_nodes);
  for (Eigen::Index node = 0; node < num_nodes; ++node) {
    // A flat place gives infinity, which max_size replaces.
    sizes[node] =
        std::min(options.max_size, options.curvature_angle / fem::norm(shape_operator, node));
    if (phases.contains(node))
      sizes[node] = std::min(sizes[node], options.interface_size * phases.width);
  }
  limit_growth(surface, graph, options.growth, sizes);
  return sizes;
}

double wanted_nodes(const mesh::Surface& surface, const Eigen::VectorXd& sizes) {
  const std::vector<double> areas = mesh::element_areas(*surface.triangulation, surface.positions);
  double sum = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    double density = 0;
    for (const mesh::NodeIndex node : surface.triangulation->triangles()[t]) {
      density += 1 / (6 * sizes[node] * sizes[node]);
    }
    sum += areas[t] * density;
  }
  return 8 / std::sqrt(3.0) * sum;
}

double longest_relative_edge(const mesh::Surface& surface, const Eigen::VectorXd& sizes) {
  double longest = 0;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const mesh::NodeIndex from = nodes[i];
      const mesh::NodeIndex to = nodes[(i + 1) % 3];
      const double length = (surface.positions.row(from) - surface.positions.row(to)).norm();
      longest = std::max(longest, 2 * length / (sizes[from] + sizes[to]));
    }
  }
  return longest;
}

Eigen::VectorXd limited_sizes(const mesh::Surface& surface, Eigen::VectorXd sizes,
                              double max_nodes) {
  const double excess = wanted_nodes(surface, sizes) / max_nodes;
  if (excess > 1) sizes *= std::sqrt(excess);
  return sizes;
}

}  // namespace vesica::adapt
