#pragma once

#include <array>

#include "vesica/core/dual.hpp"
#include "vesica/core/small_tensor.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::problem {

/// Positions and order parameter of the six nodes of an element, and what its distributional
/// curvatures need from the mesh around it.
template <class T>
struct ElementNodes {
  std::array<Vec3<T>, 6> x;
  std::array<T, 6> c{};
  std::array<ValueOf<T>, 6> vertex_angle{};  ///< 2 pi over the number of elements at the vertex
  std::array<Vec3<ValueOf<T>>, 6> normal{};  ///< directions that all elements at a node share
};

inline Vec3<double> row_of(const mesh::Positions& field, mesh::NodeIndex node) {
  return {field(node, 0), field(node, 1), field(node, 2)};
}

/// Interpolates nodal values of an element, scalars or vectors, with the weights of the nodes.
template <class V>
V interpolate_nodes(const std::array<V, 6>& nodes, const std::array<double, 6>& weights) {
  V sum = weights[0] * nodes[0];
  for (std::size_t i = 1; i < 6; ++i) sum = sum + weights[i] * nodes[i];
  return sum;
}

}  // namespace vesica::problem
