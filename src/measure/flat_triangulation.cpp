#include "flat_triangulation.hpp"

#include <algorithm>
#include <tuple>

#include "vesica/mesh/local_nodes.hpp"

namespace vesica::measure {
namespace {

struct HalfEdge {
  mesh::NodeIndex low;
  mesh::NodeIndex high;
  std::int32_t triangle;
  std::size_t side;
};

std::vector<HalfEdge> sorted_half_edges(const std::vector<mesh::Corners>& triangles) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const auto [low, high] = std::minmax(triangles[t][side], triangles[t][(side + 1) % 3]);
      half_edges.push_back({low, high, static_cast<std::int32_t>(t), side});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return half_edges;
}

}  // namespace

FlatTriangulation flat_triangulation(const mesh::Triangulation& triangulation) {
  FlatTriangulation flat;
  flat.triangles.reserve(4 * triangulation.triangles().size());
  for (const mesh::QuadraticTriangle& nodes : triangulation.triangles()) {
    for (const auto& local : mesh::sub_triangles)
      flat.triangles.push_back({nodes[local[0]], nodes[local[1]], nodes[local[2]]});
  }
  flat.edges_of.resize(flat.triangles.size());
  // Closed and manifold: the two sides of an edge follow each other.
  const std::vector<HalfEdge> half_edges = sorted_half_edges(flat.triangles);
  for (std::size_t i = 0; i < half_edges.size(); i += 2) {
    const auto edge = static_cast<std::int32_t>(flat.edges.size());
    for (const HalfEdge& half : {half_edges[i], half_edges[i + 1]})
      flat.edges_of[static_cast<std::size_t>(half.triangle)][half.side] = edge;
    flat.edges.push_back({half_edges[i].low,
                          half_edges[i].high,
                          {half_edges[i].triangle, half_edges[i + 1].triangle}});
  }
  return flat;
}

std::vector<double> areas_of(const FlatTriangulation& flat, const mesh::Positions& positions) {
  std::vector<double> areas;
  areas.reserve(flat.triangles.size());
  for (const mesh::Corners& corners : flat.triangles) {
    areas.push_back(0.5 * mesh::area_vector({positions.row(corners[0]), positions.row(corners[1]),
                                             positions.row(corners[2])})
                              .norm());
  }
  return areas;
}

}  // namespace vesica::measure
