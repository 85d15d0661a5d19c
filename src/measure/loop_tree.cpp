#include "loop_tree.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace vesica::measure {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

NodeEdges::NodeEdges(const FlatTriangulation& flat, mesh::NodeIndex num_nodes)
    : starts_(index(num_nodes) + 1), edges_(2 * flat.edges.size()) {
  for (const auto& edge : flat.edges) {
    ++starts_[index(edge.from) + 1];
    ++starts_[index(edge.to) + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t e = 0; e < flat.edges.size(); ++e) {
    edges_[next[index(flat.edges[e].from)]++] = static_cast<std::int32_t>(e);
    edges_[next[index(flat.edges[e].to)]++] = static_cast<std::int32_t>(e);
  }
}

PathTree shortest_paths(const FlatTriangulation& flat, const NodeEdges& edges_at,
                        const mesh::Positions& positions, mesh::NodeIndex first) {
  const auto num_nodes = static_cast<std::size_t>(positions.rows());
  PathTree tree;
  tree.distance.assign(num_nodes, std::numeric_limits<double>::infinity());
  tree.parent.assign(num_nodes, -1);
  tree.edge_of.assign(num_nodes, -1);
  using Entry = std::pair<double, mesh::NodeIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  tree.distance[index(first)] = 0;
  queue.emplace(0, first);
  while (!queue.empty()) {
    const auto [distance, node] = queue.top();
    queue.pop();
    if (distance > tree.distance[index(node)]) continue;
    for (const std::int32_t e : edges_at[node]) {
      const auto& edge = flat.edges[index(e)];
      const mesh::NodeIndex other = edge.from == node ? edge.to : edge.from;
      const double through = distance + (positions.row(node) - positions.row(other)).norm();
      if (through >= tree.distance[index(other)]) continue;
      tree.distance[index(other)] = through;
      tree.parent[index(other)] = node;
      tree.edge_of[index(other)] = e;
      queue.emplace(through, other);
    }
  }
  return tree;
}

namespace {

/// Depth-first search over the triangles, across edges that are not in the tree.
class SideSearch {
 public:
  SideSearch(const FlatTriangulation& flat, const std::vector<double>& areas, const PathTree& tree)
      : flat_(flat), area_(areas), lowest_(areas.size()), is_in_tree_(flat.edges.size()) {
    for (const std::int32_t edge : tree.edge_of)
      if (edge >= 0) is_in_tree_[index(edge)] = true;
    sides_.cuts.assign(flat.edges.size(), false);
    sides_.area.assign(flat.edges.size(), 0);
    sides_.top.assign(flat.edges.size(), -1);
    sides_.place.assign(areas.size(), -1);
    sides_.count.assign(areas.size(), 1);
  }

  FarSides search(std::int32_t first) {
    enter(first, -1);
    while (!stack_.empty()) {
      if (stack_.back().next_side < 3) {
        look_across(stack_.back());
      } else {
        leave();
      }
    }
    sides_.whole_area = area_[index(first)];
    return std::move(sides_);
  }

 private:
  struct Visit {
    std::int32_t triangle;
    std::int32_t through;  // edge
    std::size_t next_side = 0;
  };

  void enter(std::int32_t triangle, std::int32_t through) {
    const auto place = static_cast<std::int32_t>(sides_.order.size());
    sides_.place[index(triangle)] = place;
    lowest_[index(triangle)] = place;
    sides_.order.push_back(triangle);
    stack_.push_back({triangle, through});
  }

  void look_across(Visit& visit) {
    const std::int32_t triangle = visit.triangle;
    const std::int32_t edge = flat_.edges_of[index(triangle)][visit.next_side++];
    if (is_in_tree_[index(edge)] || edge == visit.through) return;
    const auto& pair = flat_.edges[index(edge)].triangles;
    const std::int32_t other = pair[0] == triangle ? pair[1] : pair[0];
    const std::int32_t place = sides_.place[index(other)];
    if (place < 0) {
      enter(other, edge);
    } else {
      lowest_[index(triangle)] = std::min(lowest_[index(triangle)], place);
    }
  }

  void leave() {
    const Visit visit = stack_.back();
    stack_.pop_back();
    if (stack_.empty()) return;
    const std::size_t below = index(visit.triangle);
    const std::size_t above = index(stack_.back().triangle);
    area_[above] += area_[below];
    sides_.count[above] += sides_.count[below];
    lowest_[above] = std::min(lowest_[above], lowest_[below]);
    if (lowest_[below] < sides_.place[below]) return;
    sides_.cuts[index(visit.through)] = true;
    sides_.area[index(visit.through)] = area_[below];
    sides_.top[index(visit.through)] = visit.triangle;
  }

  const FlatTriangulation& flat_;
  std::vector<double> area_;          // of a triangle and those below it
  std::vector<std::int32_t> lowest_;  // place that can be reached from below a triangle
  std::vector<bool> is_in_tree_;
  std::vector<Visit> stack_;
  FarSides sides_;
};

}  // namespace

FarSides far_sides(const FlatTriangulation& flat, const std::vector<double>& areas,
                   const PathTree& tree, std::int32_t first_triangle) {
  return SideSearch(flat, areas, tree).search(first_triangle);
}

}  // namespace vesica::measure
