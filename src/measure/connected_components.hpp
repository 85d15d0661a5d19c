#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vesica::measure {

/// Connected components of a graph.
struct Components {
  std::size_t count = 0;
  std::vector<std::size_t> of_vertex;  ///< number of its component, below count
};

/// Components of the graph with vertices 0 .. num_vertices - 1, numbered by their first vertices.
[[nodiscard]] inline Components connected_components(
    std::size_t num_vertices, const std::vector<std::array<std::size_t, 2>>& links) {
  std::vector<std::size_t> parent(num_vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t vertex) {
    while (parent[vertex] != vertex) {
      parent[vertex] = parent[parent[vertex]];
      vertex = parent[vertex];
    }
    return vertex;
  };
  for (const auto& [a, b] : links) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent[high] = low;
  }
  Components components;
  components.of_vertex.resize(num_vertices);
  for (std::size_t vertex = 0; vertex < num_vertices; ++vertex) {
    const std::size_t first = root(vertex);
    components.of_vertex[vertex] =
        first == vertex ? components.count++ : components.of_vertex[first];
  }
  return components;
}

}  // namespace vesica::measure
