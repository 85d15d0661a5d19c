#include "bisector.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "vesica/mesh/local_nodes.hpp"

namespace vesica::paper {
namespace {

using mesh::NodeIndex;

/// A place of each old node in one of its triangles.
std::vector<mesh::SurfaceLocation> own_places(const mesh::Surface& surface) {
  std::vector<mesh::SurfaceLocation> places(static_cast<std::size_t>(surface.positions.rows()));
  NodeIndex t = 0;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    for (std::size_t i = 0; i < 6; ++i) {
      const auto [u, v] = mesh::node_parameters[i];
      places[static_cast<std::size_t>(nodes[i])] = {t, u, v, surface.positions.row(nodes[i]), 0};
    }
    ++t;
  }
  return places;
}

}  // namespace

Bisector::Bisector(const mesh::Surface& old, const BisectedEdges& edges)
    : old_(old), edges_(edges) {}

void Bisector::add(NodeIndex triangle) {
  const auto& nodes = old_.triangulation->triangles()[static_cast<std::size_t>(triangle)];
  const auto is_bisected = [&](std::size_t side) {
    return edges_.has_node[static_cast<std::size_t>(nodes[3 + side])];
  };
  if (!is_bisected(0) && !is_bisected(1) && !is_bisected(2)) {
    triangles_.push_back(nodes);
    return;
  }
  add(triangle,
      {{nodes[0], nodes[1], nodes[2]}, {{{0, 0}, {1, 0}, {0, 1}}}, {nodes[3], nodes[4], nodes[5]}},
      refinement_side(old_, nodes));
}

/// `first_side` is bisected first, if at all; in the children it is the side opposite the new
/// vertex.
void Bisector::add(NodeIndex triangle, const Part& part, std::size_t first_side) {
  const std::size_t a = first_side;
  const std::size_t b = (a + 1) % 3;
  const std::size_t apex = (a + 2) % 3;
  const NodeIndex middle = part.middles[a];
  if (middle >= 0 && edges_.has_node[static_cast<std::size_t>(middle)]) {
    const Eigen::Vector2d place = 0.5 * (part.places[a] + part.places[b]);
    const Part first{{part.corners[apex], part.corners[a], middle},
                     {part.places[apex], part.places[a], place},
                     {part.middles[apex], -1, -1}};
    const Part second{{part.corners[b], part.corners[apex], middle},
                      {part.places[b], part.places[apex], place},
                      {part.middles[b], -1, -1}};
    add(triangle, first, 0);
    add(triangle, second, 0);
    return;
  }
  mesh::QuadraticTriangle nodes{part.corners[0], part.corners[1], part.corners[2]};
  for (std::size_t side = 0; side < 3; ++side) nodes[3 + side] = middle_of(triangle, part, side);
  triangles_.push_back(nodes);
}

NodeIndex Bisector::middle_of(NodeIndex triangle, const Part& part, std::size_t side) {
  if (part.middles[side] >= 0) return part.middles[side];
  const std::size_t next = (side + 1) % 3;
  const auto [low, high] = std::minmax(part.corners[side], part.corners[next]);
  const auto number =
      static_cast<NodeIndex>(old_.positions.rows() + static_cast<Eigen::Index>(new_nodes_.size()));
  const auto [entry, is_new] = new_middles_.try_emplace(mesh::Edge{low, high}, number);
  if (is_new) {
    const Eigen::Vector2d place = 0.5 * (part.places[side] + part.places[next]);
    mesh::SurfaceLocation location{triangle, place.x(), place.y(), {}, 0};
    location.point = mesh::interpolate(*old_.triangulation, location, old_.positions);
    new_nodes_.push_back(location);
  }
  return entry->second;
}

adapt::Remeshed Bisector::result() const {
  std::vector<mesh::SurfaceLocation> all = own_places(old_);
  all.insert(all.end(), new_nodes_.begin(), new_nodes_.end());
  std::vector<NodeIndex> numbers(all.size(), -1);
  for (const mesh::QuadraticTriangle& nodes : triangles_) {
    for (const NodeIndex node : nodes) numbers[static_cast<std::size_t>(node)] = 0;
  }
  adapt::Remeshed result;
  for (std::size_t node = 0; node < all.size(); ++node) {
    if (numbers[node] < 0) continue;
    numbers[node] = static_cast<NodeIndex>(result.origins.size());
    result.origins.push_back(all[node]);
  }
  auto triangles = triangles_;
  for (mesh::QuadraticTriangle& nodes : triangles) {
    for (NodeIndex& node : nodes) node = numbers[static_cast<std::size_t>(node)];
  }
  result.surface.positions.resize(static_cast<Eigen::Index>(result.origins.size()), 3);
  Eigen::Index row = 0;
  for (const auto& origin : result.origins)
    result.surface.positions.row(row++) = origin.point.transpose();
  result.surface.triangulation = std::make_shared<const mesh::Triangulation>(
      std::move(triangles), static_cast<NodeIndex>(result.origins.size()));
  return result;
}

}  // namespace vesica::paper
