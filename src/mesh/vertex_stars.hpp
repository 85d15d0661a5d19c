#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// The triangles around each corner node; none for mid-edge nodes.
class VertexStars {
 public:
  explicit VertexStars(const Triangulation& triangulation);

  [[nodiscard]] std::span<const NodeIndex> operator[](NodeIndex node) const {
    const auto i = static_cast<std::size_t>(node);
    return std::span(triangles_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<NodeIndex> triangles_;
};

}  // namespace vesica::mesh
