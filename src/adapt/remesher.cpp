#include "remesher.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace vesica::adapt {
namespace {

using Eigen::Vector3d;
using mesh::SurfaceLocation;

constexpr double long_edge = 1.36;
constexpr double short_edge = 0.72;
/// Quality that edge operations may leave behind for the smoothing.
constexpr double rough_quality = 0.25;
constexpr int max_valence = 9;

int valence_defect(int valence) { return (valence - 6) * (valence - 6); }

}  // namespace

Remesher::Remesher(const mesh::SurfaceLocator& old, const Eigen::VectorXd& sizes)
    : old_(old),
      sizes_(sizes),
      mesh_(old.triangulation()),
      vertices_(static_cast<std::size_t>(old.triangulation().num_nodes())) {
  constexpr std::array<std::array<double, 2>, 3> parameters = {{{0, 0}, {1, 0}, {0, 1}}};
  for (NodeIndex v = 0; v < mesh_.num_vertices(); ++v) {
    if (mesh_.star(v).empty()) continue;  // a mid-edge node
    const NodeIndex t = mesh_.star(v).front();
    const Corners& corners = mesh_.corners(t);
    const auto i =
        static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    const auto [u, w] = parameters[i];
    vertices_[static_cast<std::size_t>(v)] = at_place({t, u, w, old.positions().row(v), 0});
  }
}

double Remesher::relative_length(const SurfaceVertex& a, const SurfaceVertex& b) const {
  return (b.place.point - a.place.point).norm() / (0.5 * (a.size + b.size));
}

SurfaceVertex Remesher::at_place(const SurfaceLocation& place) const {
  const auto& nodes = old_.triangulation().triangles()[static_cast<std::size_t>(place.triangle)];
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const NodeIndex node : nodes) {
    smallest = std::min(smallest, sizes_[node]);
    largest = std::max(largest, sizes_[node]);
  }
  // Quadratic interpolation may overshoot.
  const double size = std::clamp(old_.interpolate(place, sizes_).value(), smallest, largest);
  return {place, old_.normal(place), size};
}

SurfaceLocation Remesher::closest(const SurfaceVertex& from, const Vector3d& point) const {
  const SurfaceLocation walked = old_.closest_from(from.place, point);
  return old_.normal(walked).dot(from.normal) > 0 ? walked : old_.closest(point, from.normal);
}

SurfaceLocation Remesher::middle_of(const SurfaceVertex& a, const SurfaceVertex& b) const {
  const Vector3d middle = 0.5 * (a.place.point + b.place.point);
  const Vector3d normal = a.normal + b.normal;
  // On a rough surface one of the walks may end in a local minimum.
  const SurfaceLocation from_a = old_.closest_from(a.place, middle);
  const SurfaceLocation from_b = old_.closest_from(b.place, middle);
  const SurfaceLocation& closer = from_a.distance <= from_b.distance ? from_a : from_b;
  return old_.normal(closer).dot(normal) > 0 ? closer : old_.closest(middle, normal);
}

Fitness Remesher::fitness_of(std::span<const NodeIndex> triangles) const {
  Fitness fitness;
  for (const NodeIndex t : triangles) {
    const auto [a, b, c] = mesh_.corners(t);
    fitness.include(vertex(a), vertex(b), vertex(c));
  }
  return fitness;
}

Fitness Remesher::fitness_with(std::span<const NodeIndex> triangles,
                               const Substitute& substitute) const {
  Fitness fitness;
  const auto& replaced = substitute.replaced;
  for (const NodeIndex t : triangles) {
    std::array<const SurfaceVertex*, 3> corners{};
    int num_replaced = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeIndex v = mesh_.corners(t)[i];
      const bool is_replaced = v == replaced[0] || v == replaced[1];
      num_replaced += is_replaced ? 1 : 0;
      corners[i] = is_replaced ? &substitute.vertex : &vertex(v);
    }
    if (num_replaced < 2) fitness.include(*corners[0], *corners[1], *corners[2]);
  }
  return fitness;
}

Fitness Remesher::fitness_flipped(NodeIndex a, NodeIndex b,
                                  const EditableMesh::EdgeSides& sides) const {
  const auto [left, right] = sides.opposite;
  Fitness fitness;
  fitness.include(vertex(a), vertex(right), vertex(left));
  fitness.include(vertex(b), vertex(left), vertex(right));
  return fitness;
}

std::vector<mesh::Edge> Remesher::edges_by_relative_length(double above, double below) const {
  std::vector<std::pair<double, mesh::Edge>> found;
  for (const mesh::Edge& edge : mesh_.edges()) {
    const double length = relative_length(vertex(edge[0]), vertex(edge[1]));
    if (length > above && length < below) found.emplace_back(length, edge);
  }
  std::sort(found.begin(), found.end());
  std::vector<mesh::Edge> edges;
  edges.reserve(found.size());
  for (const auto& [length, edge] : found) edges.push_back(edge);
  return edges;
}

int Remesher::split_long_edges() {
  const auto edges = edges_by_relative_length(long_edge, std::numeric_limits<double>::infinity());
  return static_cast<int>(std::count_if(edges.rbegin(), edges.rend(), [&](const mesh::Edge& edge) {
    return try_split(edge[0], edge[1]);
  }));
}

bool Remesher::try_split(NodeIndex a, NodeIndex b) {
  const auto sides = mesh_.sides(a, b);
  const Fitness before = fitness_of(sides->triangles);
  const SurfaceVertex middle = at_place(middle_of(vertex(a), vertex(b)));
  Fitness after;
  for (const NodeIndex replaced : {a, b}) {
    const Fitness half = fitness_with(sides->triangles, {{replaced, replaced}, middle});
    after.quality = std::min(after.quality, half.quality);
    after.uprightness = std::min(after.uprightness, half.uprightness);
  }
  // Halving a triangle may halve its angles; a flat middle would make a triangle without area.
  if (!after.is_as_good_as(before, std::min(rough_quality, 0.3 * before.quality))) return false;
  mesh_.split(a, b);
  vertices_.push_back(middle);
  return true;
}

int Remesher::collapse_short_edges() {
  int count = 0;
  for (const auto& [a, b] : edges_by_relative_length(-1, short_edge)) {
    // Earlier collapses may have taken or stretched it.
    if (!mesh_.sides(a, b) || relative_length(vertex(a), vertex(b)) >= short_edge) continue;
    if (try_collapse(a, b)) ++count;
  }
  return count;
}

bool Remesher::has_long_edge(NodeIndex a, NodeIndex b, const SurfaceVertex& merged) const {
  for (const NodeIndex end : {a, b}) {
    for (const NodeIndex v : mesh_.neighbours(end)) {
      if (v != a && v != b && relative_length(merged, vertex(v)) > long_edge) return true;
    }
  }
  return false;
}

bool Remesher::try_collapse(NodeIndex a, NodeIndex b) {
  const auto sides = mesh_.sides(a, b);
  const auto [left, right] = sides->opposite;
  const int valence = mesh_.valence(a) + mesh_.valence(b) - 4;
  if (valence > max_valence || mesh_.valence(left) <= 3 || mesh_.valence(right) <= 3) return false;
  if (!mesh_.can_collapse(a, b)) return false;
  std::vector<NodeIndex> triangles(mesh_.star(a).begin(), mesh_.star(a).end());
  triangles.insert(triangles.end(), mesh_.star(b).begin(), mesh_.star(b).end());
  const Fitness before = fitness_of(triangles);
  const SurfaceVertex middle = at_place(middle_of(vertex(a), vertex(b)));
  for (const SurfaceVertex& merged : {middle, vertex(a), vertex(b)}) {
    if (has_long_edge(a, b, merged)) continue;
    if (!fitness_with(triangles, {{a, b}, merged}).is_as_good_as(before, rough_quality)) continue;
    vertices_[static_cast<std::size_t>(a)] = merged;
    mesh_.collapse(a, b);
    return true;
  }
  return false;
}

int Remesher::flip_towards_valence_six() {
  int count = 0;
  for (const auto& [a, b] : mesh_.edges()) {
    const auto sides = mesh_.sides(a, b);
    if (!sides) continue;  // flipped away
    int gain = 0;
    for (const NodeIndex v : {a, b}) {
      gain += valence_defect(mesh_.valence(v)) - valence_defect(mesh_.valence(v) - 1);
    }
    for (const NodeIndex v : sides->opposite) {
      gain += valence_defect(mesh_.valence(v)) - valence_defect(mesh_.valence(v) + 1);
    }
    if (gain <= 0 || !mesh_.can_flip(a, b)) continue;
    const Fitness before = fitness_of(sides->triangles);
    if (!fitness_flipped(a, b, *sides).is_as_good_as(before, rough_quality)) continue;
    mesh_.flip(a, b);
    ++count;
  }
  return count;
}

int Remesher::flip_for_angles() {
  int count = 0;
  for (const auto& [a, b] : mesh_.edges()) {
    const auto sides = mesh_.sides(a, b);
    if (!sides) continue;  // flipped away
    const Fitness before = fitness_of(sides->triangles);
    const Fitness after = fitness_flipped(a, b, *sides);
    if (after.quality <= 1.01 * before.quality || !after.is_as_good_as(before, 1)) continue;
    if (!mesh_.can_flip(a, b)) continue;
    mesh_.flip(a, b);
    ++count;
  }
  return count;
}

Vector3d Remesher::weighted_centroid(NodeIndex v) const {
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (const NodeIndex t : mesh_.star(v)) {
    const auto [a, b, c] = mesh_.corners(t);
    const Vector3d& x = vertex(a).place.point;
    const Vector3d& y = vertex(b).place.point;
    const Vector3d& z = vertex(c).place.point;
    const double size = (vertex(a).size + vertex(b).size + vertex(c).size) / 3;
    const double weight = (y - x).cross(z - x).norm() / std::pow(size, 4);
    sum += weight / 3 * (x + y + z);
    weights += weight;
  }
  return sum / weights;
}

void Remesher::smooth(double enough) {
  for (NodeIndex v = 0; v < mesh_.num_vertices(); ++v) {
    if (mesh_.star(v).empty()) continue;
    const Vector3d start = vertex(v).place.point;
    const Vector3d step = weighted_centroid(v) - start;
    const Fitness before = fitness_of(mesh_.star(v));
    for (const double part : {1.0, 0.5, 0.25}) {
      const SurfaceVertex moved = at_place(closest(vertex(v), start + part * step));
      if (!fitness_with(mesh_.star(v), {{v, v}, moved}).is_as_good_as(before, enough)) continue;
      vertices_[static_cast<std::size_t>(v)] = moved;
      break;
    }
  }
}

Remeshed Remesher::result() const {
  std::vector<NodeIndex> new_number(vertices_.size(), -1);
  std::vector<SurfaceVertex> kept;
  for (NodeIndex v = 0; v < mesh_.num_vertices(); ++v) {
    if (mesh_.star(v).empty()) continue;
    new_number[static_cast<std::size_t>(v)] = static_cast<NodeIndex>(kept.size());
    kept.push_back(vertex(v));
  }
  std::vector<Corners> triangles = mesh_.triangles();
  for (Corners& corners : triangles) {
    for (NodeIndex& v : corners) v = new_number[static_cast<std::size_t>(v)];
  }
  auto connectivity = mesh::add_edge_nodes(triangles, static_cast<NodeIndex>(kept.size()));
  std::vector<SurfaceLocation> origins;
  origins.reserve(kept.size() + connectivity.edges.size());
  for (const SurfaceVertex& vertex : kept) origins.push_back(vertex.place);
  for (const auto& [a, b] : connectivity.edges) {
    origins.push_back(
        middle_of(kept[static_cast<std::size_t>(a)], kept[static_cast<std::size_t>(b)]));
  }
  mesh::Positions positions(static_cast<Eigen::Index>(origins.size()), 3);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    positions.row(static_cast<Eigen::Index>(i)) = origins[i].point.transpose();
  }
  auto triangulation = std::make_shared<const mesh::Triangulation>(
      std::move(connectivity.triangles), static_cast<NodeIndex>(origins.size()));
  return {{std::move(triangulation), std::move(positions)}, std::move(origins)};
}

}  // namespace vesica::adapt
