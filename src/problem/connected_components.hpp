#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vesica::problem {

/// Number of connected components of a graph with vertices 0 .. num_vertices - 1.
[[nodiscard]] inline int num_components(std::size_t num_vertices,
                                        const std::vector<std::array<std::size_t, 2>>& links) {
  std::vector<std::size_t> parent(num_vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t vertex) {
    while (parent[vertex] != vertex) {
      parent[vertex] = parent[parent[vertex]];
      vertex = parent[vertex];
    }
    return vertex;
  };
  auto components = static_cast<int>(num_vertices);
  for (const auto& [a, b] : links) {
    const auto root_a = root(a);
    const auto root_b = root(b);
    if (root_a == root_b) continue;
    parent[root_b] = root_a;
    --components;
  }
  return components;
}

}  // namespace vesica::problem
