#include "bisected_edges.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace vesica::paper {
namespace {

/// The edge opposite the newest vertex keeps the angles of all generations apart from 0; on a mesh
/// that has moved, or was not made by bisection, it may have become too short for that.
constexpr double long_enough = 0.6;

}  // namespace

std::array<double, 3> side_lengths(const mesh::Surface& surface,
                                   const mesh::QuadraticTriangle& nodes) {
  std::array<double, 3> lengths{};
  for (std::size_t side = 0; side < 3; ++side) {
    const mesh::NodeIndex from = nodes[side];
    const mesh::NodeIndex to = nodes[(side + 1) % 3];
    lengths[side] = (surface.positions.row(to) - surface.positions.row(from)).norm();
  }
  return lengths;
}

std::size_t refinement_side(const mesh::Surface& surface, const mesh::QuadraticTriangle& nodes) {
  const auto lengths = side_lengths(surface, nodes);
  const auto longest = std::max_element(lengths.begin(), lengths.end());
  if (lengths[0] >= long_enough * *longest) return 0;
  return static_cast<std::size_t>(longest - lengths.begin());
}

mesh::Surface with_longest_sides_first(const mesh::Surface& surface) {
  std::vector<mesh::QuadraticTriangle> triangles(surface.triangulation->triangles().begin(),
                                                 surface.triangulation->triangles().end());
  for (mesh::QuadraticTriangle& nodes : triangles) {
    const auto lengths = side_lengths(surface, nodes);
    std::size_t longest = 0;
    for (const std::size_t side : {1U, 2U}) {
      if (std::pair(lengths[side], nodes[3 + side]) >
          std::pair(lengths[longest], nodes[3 + longest]))
        longest = side;
    }
    std::rotate(nodes.begin(), nodes.begin() + static_cast<int>(longest), nodes.begin() + 3);
    std::rotate(nodes.begin() + 3, nodes.begin() + 3 + static_cast<int>(longest), nodes.end());
  }
  return {std::make_shared<const mesh::Triangulation>(std::move(triangles),
                                                      surface.triangulation->num_nodes()),
          surface.positions};
}

BisectedEdges bisected_edges(const mesh::Surface& surface, std::span<const Mark> marks) {
  const auto triangles = surface.triangulation->triangles();
  BisectedEdges edges{std::vector<bool>(static_cast<std::size_t>(surface.positions.rows())), 0};
  const auto is_bisected = [&edges](mesh::NodeIndex middle) {
    return edges.has_node[static_cast<std::size_t>(middle)];
  };
  bool is_conforming = false;
  while (!is_conforming) {
    is_conforming = true;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const mesh::QuadraticTriangle& nodes = triangles[t];
      const bool must_bisect = marks[t] == Mark::refine || is_bisected(nodes[3]) ||
                               is_bisected(nodes[4]) || is_bisected(nodes[5]);
      if (!must_bisect) continue;
      const mesh::NodeIndex middle = nodes[3 + refinement_side(surface, nodes)];
      if (is_bisected(middle)) continue;
      edges.has_node[static_cast<std::size_t>(middle)] = true;
      ++edges.count;
      is_conforming = false;
    }
  }
  return edges;
}

}  // namespace vesica::paper
