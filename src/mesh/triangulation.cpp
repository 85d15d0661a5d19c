#include "vesica/mesh/triangulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "disjoint_sets.hpp"
#include "vesica/core/error.hpp"

namespace vesica::mesh {
namespace {

/// One side of one triangle, from corner `side` to the next.
struct HalfEdge {
  NodeIndex low;
  NodeIndex high;
  NodeIndex middle;
  NodeIndex triangle;
  std::size_t side;
  bool is_ascending;  ///< the triangle runs from low to high
};

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) {
  throw ConfigError("triangulation: " + fmt::format(text, std::forward<Args>(args)...));
}

void check_nodes(std::span<const QuadraticTriangle> triangles, NodeIndex num_nodes) {
  if (triangles.empty()) refuse("no triangles: must have at least 4");
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const NodeIndex node : triangles[t]) {
      if (node < 0 || node >= num_nodes) {
        refuse("triangle {} has node {}: must be in [0, {})", t, node, num_nodes);
      }
      if (std::count(triangles[t].begin(), triangles[t].end(), node) > 1) {
        refuse("triangle {} repeats node {}: its six nodes must differ", t, node);
      }
    }
  }
}

std::vector<HalfEdge> sorted_half_edges(std::span<const QuadraticTriangle> triangles) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const NodeIndex from = triangles[t][side];
      const NodeIndex to = triangles[t][(side + 1) % 3];
      half_edges.push_back({std::min(from, to), std::max(from, to), triangles[t][3 + side],
                            static_cast<NodeIndex>(t), side, from < to});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return half_edges;
}

void check_pair(const HalfEdge& first, const HalfEdge& second) {
  if (first.is_ascending == second.is_ascending) {
    refuse("edge ({}, {}): triangles {} and {} are oriented inconsistently", first.low, first.high,
           first.triangle, second.triangle);
  }
  if (first.middle != second.middle) {
    refuse("edge ({}, {}): triangles {} and {} disagree on its mid-edge node ({} and {})",
           first.low, first.high, first.triangle, second.triangle, first.middle, second.middle);
  }
}

/// After this check entries 2 e and 2 e + 1 are the two sides of edge e.
void check_edges(std::span<const HalfEdge> half_edges) {
  std::size_t begin = 0;
  while (begin < half_edges.size()) {
    const HalfEdge& first = half_edges[begin];
    std::size_t end = begin;
    while (end < half_edges.size() && half_edges[end].low == first.low &&
           half_edges[end].high == first.high) {
      ++end;
    }
    if (end - begin == 1) {
      refuse("edge ({}, {}) belongs to 1 triangle ({}): the surface must be closed", first.low,
             first.high, first.triangle);
    }
    if (end - begin > 2) {
      refuse("edge ({}, {}) belongs to {} triangles: the surface must be manifold", first.low,
             first.high, end - begin);
    }
    check_pair(first, half_edges[begin + 1]);
    begin = end;
  }
}

/// Returns the number of corner nodes; refuses nodes that are unused or have two roles.
NodeIndex check_roles(std::span<const HalfEdge> half_edges, NodeIndex num_nodes) {
  constexpr NodeIndex unused = -2;
  constexpr NodeIndex corner = -1;
  std::vector<NodeIndex> role(static_cast<std::size_t>(num_nodes), unused);
  NodeIndex num_corners = 0;
  for (const HalfEdge& side : half_edges) {
    for (const NodeIndex node : {side.low, side.high}) {
      NodeIndex& entry = role[static_cast<std::size_t>(node)];
      if (entry == unused) ++num_corners;
      entry = corner;
    }
  }
  for (std::size_t i = 0; i < half_edges.size(); ++i) {
    const HalfEdge& side = half_edges[i];
    NodeIndex& entry = role[static_cast<std::size_t>(side.middle)];
    const auto edge = static_cast<NodeIndex>(i / 2);
    if (entry == corner) {
      refuse("edge ({}, {}): its mid-edge node {} is a corner of another triangle", side.low,
             side.high, side.middle);
    }
    if (entry != unused && entry != edge) {
      refuse("edge ({}, {}): its mid-edge node {} belongs to another edge", side.low, side.high,
             side.middle);
    }
    entry = edge;
  }
  const auto free_node = std::find(role.begin(), role.end(), unused);
  if (free_node != role.end()) refuse("node {} is in no triangle", free_node - role.begin());
  return num_corners;
}

/// Corner of a triangle as a number; `side` starts (0) or ends (1) at it.
std::size_t wedge(const HalfEdge& half_edge, NodeIndex node) {
  const bool is_start = (node == half_edge.low) == half_edge.is_ascending;
  const std::size_t corner = is_start ? half_edge.side : (half_edge.side + 1) % 3;
  return 3 * static_cast<std::size_t>(half_edge.triangle) + corner;
}

void check_fans(std::span<const QuadraticTriangle> triangles, std::span<const HalfEdge> half_edges,
                NodeIndex num_nodes) {
  DisjointSets fans(3 * triangles.size());
  for (std::size_t i = 0; i < half_edges.size(); i += 2) {
    for (const NodeIndex node : {half_edges[i].low, half_edges[i].high}) {
      fans.join(wedge(half_edges[i], node), wedge(half_edges[i + 1], node));
    }
  }
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> fan_of(static_cast<std::size_t>(num_nodes), none);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const NodeIndex node = triangles[t][corner];
      std::size_t& known = fan_of[static_cast<std::size_t>(node)];
      const std::size_t fan = fans.find(3 * t + corner);
      if (known == none) known = fan;
      if (known != fan) {
        refuse(
            "node {}: triangles {} and {} meet only there: the triangles around a node must form "
            "one fan",
            node, known / 3, t);
      }
    }
  }
}

int count_components(std::span<const HalfEdge> half_edges, std::size_t num_triangles) {
  DisjointSets components(num_triangles);
  for (std::size_t i = 0; i < half_edges.size(); i += 2) {
    components.join(static_cast<std::size_t>(half_edges[i].triangle),
                    static_cast<std::size_t>(half_edges[i + 1].triangle));
  }
  return static_cast<int>(components.num_sets());
}

}  // namespace

Triangulation::Triangulation(std::vector<QuadraticTriangle> triangles, NodeIndex num_nodes)
    : triangles_(std::move(triangles)), num_nodes_(num_nodes) {
  check_nodes(triangles_, num_nodes_);
  const std::vector<HalfEdge> half_edges = sorted_half_edges(triangles_);
  check_edges(half_edges);
  num_vertices_ = check_roles(half_edges, num_nodes_);
  check_fans(triangles_, half_edges, num_nodes_);
  num_components_ = count_components(half_edges, triangles_.size());
}

}  // namespace vesica::mesh
