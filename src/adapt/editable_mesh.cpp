#include "editable_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace vesica::adapt {
namespace {

constexpr Corners gone = {-1, -1, -1};

/// Number of the vertex in the triangle, 3 when it is none of its corners.
std::size_t place_of(const Corners& corners, NodeIndex vertex) {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) -
                                  corners.begin());
}

std::vector<Corners> corners_of(const mesh::Triangulation& triangulation) {
  std::vector<Corners> corners;
  corners.reserve(triangulation.triangles().size());
  for (const auto& nodes : triangulation.triangles())
    corners.push_back({nodes[0], nodes[1], nodes[2]});
  return corners;
}

}  // namespace

EditableMesh::EditableMesh(const mesh::Triangulation& triangulation)
    : EditableMesh(corners_of(triangulation), triangulation.num_nodes()) {}

EditableMesh::EditableMesh(std::vector<Corners> triangles, NodeIndex num_vertices)
    : triangles_(std::move(triangles)), stars_(at(num_vertices)) {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const NodeIndex vertex : triangles_[t]) {
      stars_[at(vertex)].push_back(static_cast<NodeIndex>(t));
    }
  }
}

std::vector<NodeIndex> EditableMesh::neighbours(NodeIndex vertex) const {
  std::vector<NodeIndex> result;
  result.reserve(star(vertex).size());
  for (const NodeIndex t : star(vertex)) {
    result.push_back(corners(t)[(place_of(corners(t), vertex) + 1) % 3]);
  }
  return result;
}

std::optional<EditableMesh::EdgeSides> EditableMesh::sides(NodeIndex a, NodeIndex b) const {
  EdgeSides result{{-1, -1}, {-1, -1}};
  for (const NodeIndex t : star(a)) {
    const std::size_t place = place_of(corners(t), a);
    const NodeIndex next = corners(t)[(place + 1) % 3];
    const NodeIndex last = corners(t)[(place + 2) % 3];
    if (next == b) {
      result.triangles[0] = t;
      result.opposite[0] = last;
    } else if (last == b) {
      result.triangles[1] = t;
      result.opposite[1] = next;
    }
  }
  if (result.triangles[0] < 0 || result.triangles[1] < 0) return std::nullopt;
  return result;
}

std::vector<mesh::Edge> EditableMesh::edges() const {
  std::vector<mesh::Edge> result;
  result.reserve(3 * triangles_.size() / 2);
  for (const Corners& c : triangles_) {
    for (std::size_t i = 0; i < 3; ++i) {
      // Every edge runs upwards in exactly one of its triangles; a triangle that is gone has none.
      if (c[i] < c[(i + 1) % 3]) result.push_back({c[i], c[(i + 1) % 3]});
    }
  }
  return result;
}

std::vector<Corners> EditableMesh::triangles() const {
  std::vector<Corners> result;
  result.reserve(triangles_.size());
  std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(result),
               [](const Corners& corners) { return corners != gone; });
  return result;
}

NodeIndex EditableMesh::split(NodeIndex a, NodeIndex b) {
  const auto edge = sides(a, b);
  assert(edge);
  const NodeIndex middle = num_vertices();
  stars_.emplace_back();
  const auto [first, second] = edge->triangles;
  const auto [left, right] = edge->opposite;
  replace_corner(first, b, middle);
  replace_corner(second, b, middle);
  add_triangle({middle, b, left});
  add_triangle({b, middle, right});
  return middle;
}

bool EditableMesh::can_collapse(NodeIndex a, NodeIndex b) const {
  if (valence(a) + valence(b) <= 6) return false;  // would leave fewer than three triangles at a
  const std::vector<NodeIndex> around_a = neighbours(a);
  const std::vector<NodeIndex> around_b = neighbours(b);
  const auto num_common = std::count_if(around_a.begin(), around_a.end(), [&](NodeIndex v) {
    return std::find(around_b.begin(), around_b.end(), v) != around_b.end();
  });
  return num_common == 2;
}

void EditableMesh::collapse(NodeIndex a, NodeIndex b) {
  const auto edge = sides(a, b);
  assert(edge);
  for (const NodeIndex t : edge->triangles) {
    for (const NodeIndex vertex : corners(t)) leave(t, vertex);
    triangles_[at(t)] = gone;
  }
  const std::vector<NodeIndex> left_over = stars_[at(b)];
  for (const NodeIndex t : left_over) replace_corner(t, b, a);
}

bool EditableMesh::can_flip(NodeIndex a, NodeIndex b) const {
  const auto edge = sides(a, b);
  return edge && edge->opposite[0] != edge->opposite[1] && valence(a) > 3 && valence(b) > 3 &&
         !sides(edge->opposite[0], edge->opposite[1]);
}

void EditableMesh::flip(NodeIndex a, NodeIndex b) {
  const auto edge = sides(a, b);
  assert(edge);
  const auto [first, second] = edge->triangles;
  const auto [left, right] = edge->opposite;
  replace_corner(first, b, right);
  replace_corner(second, a, left);
}

void EditableMesh::add_triangle(const Corners& corners) {
  const auto t = static_cast<NodeIndex>(triangles_.size());
  triangles_.push_back(corners);
  for (const NodeIndex vertex : corners) stars_[at(vertex)].push_back(t);
}

void EditableMesh::leave(NodeIndex triangle, NodeIndex vertex) {
  auto& star = stars_[at(vertex)];
  star.erase(std::find(star.begin(), star.end(), triangle));
}

void EditableMesh::replace_corner(NodeIndex triangle, NodeIndex old_vertex, NodeIndex new_vertex) {
  leave(triangle, old_vertex);
  stars_[at(new_vertex)].push_back(triangle);
  Corners& corners = triangles_[at(triangle)];
  corners[place_of(corners, old_vertex)] = new_vertex;
}

}  // namespace vesica::adapt
