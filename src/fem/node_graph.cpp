#include "vesica/fem/node_graph.hpp"

#include <algorithm>

namespace vesica::fem {

namespace {

template <class T>
std::span<const T> slice(const std::vector<T>& values, const std::vector<std::int64_t>& starts,
                         std::int64_t i) {
  const auto begin = starts[static_cast<std::size_t>(i)];
  const auto end = starts[static_cast<std::size_t>(i) + 1];
  return std::span(values).subspan(static_cast<std::size_t>(begin),
                                   static_cast<std::size_t>(end - begin));
}

}  // namespace

NodeGraph::NodeGraph(const mesh::Triangulation& triangulation) {
  struct Entry {
    std::int32_t neighbour;
    std::int32_t code;
  };
  const auto triangles = triangulation.triangles();
  std::vector<std::vector<Entry>> entries(at(triangulation.num_nodes()));
  std::vector<std::vector<std::int32_t>> corners(at(triangulation.num_nodes()));
  for (std::int32_t t = 0; t < triangulation.num_triangles(); ++t) {
    const auto& triangle = triangles[at(t)];
    for (std::int32_t i = 0; i < 6; ++i) {
      corners[at(triangle[at(i)])].push_back(t * 6 + i);
      for (std::int32_t j = 0; j < 6; ++j) {
        entries[at(triangle[at(i)])].push_back({triangle[at(j)], t * 36 + i * 6 + j});
      }
    }
  }
  node_starts_.push_back(0);
  incidence_starts_.push_back(0);
  contribution_starts_.push_back(0);
  for (std::size_t node = 0; node < entries.size(); ++node) {
    auto& list = entries[node];
    std::stable_sort(list.begin(), list.end(),
                     [](const Entry& a, const Entry& b) { return a.neighbour < b.neighbour; });
    for (std::size_t k = 0; k < list.size(); ++k) {
      const bool is_new = k == 0 || list[k].neighbour != list[k - 1].neighbour;
      if (is_new && k > 0)
        contribution_starts_.push_back(static_cast<std::int64_t>(contributions_.size()));
      if (is_new) neighbours_.push_back(list[k].neighbour);
      contributions_.push_back(list[k].code);
    }
    contribution_starts_.push_back(static_cast<std::int64_t>(contributions_.size()));
    node_starts_.push_back(static_cast<std::int64_t>(neighbours_.size()));
    incidences_.insert(incidences_.end(), corners[node].begin(), corners[node].end());
    incidence_starts_.push_back(static_cast<std::int64_t>(incidences_.size()));
  }
}

std::span<const std::int32_t> NodeGraph::neighbours(std::int32_t node) const {
  return slice(neighbours_, node_starts_, node);
}

std::span<const std::int32_t> NodeGraph::incidences(std::int32_t node) const {
  return slice(incidences_, incidence_starts_, node);
}

std::span<const std::int32_t> NodeGraph::contributions(std::int64_t pair) const {
  return slice(contributions_, contribution_starts_, pair);
}

linalg::SparseMatrix NodeGraph::block_pattern(int block_size) const {
  linalg::SparseMatrix matrix;
  const std::int64_t block = block_size;
  matrix.size = num_nodes() * block;
  matrix.column_starts.reserve(at(matrix.size + 1));
  matrix.rows.reserve(at(num_pairs() * block * block));
  matrix.column_starts.push_back(0);
  for (std::int32_t node = 0; node < num_nodes(); ++node) {
    for (std::int64_t column = 0; column < block; ++column) {
      for (const auto neighbour : neighbours(node)) {
        for (std::int64_t row = 0; row < block; ++row)
          matrix.rows.push_back(neighbour * block + row);
      }
      matrix.column_starts.push_back(static_cast<std::int64_t>(matrix.rows.size()));
    }
  }
  matrix.values.assign(matrix.rows.size(), 0.0);
  return matrix;
}

}  // namespace vesica::fem
