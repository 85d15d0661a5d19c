#include "vertex_stiffness.hpp"

#include <Eigen/Geometry>

namespace vesica::paper {

VertexNumbers vertex_numbers(const mesh::Triangulation& triangulation) {
  VertexNumbers numbers;
  numbers.vertex_of_node.assign(static_cast<std::size_t>(triangulation.num_nodes()), -1);
  for (const mesh::QuadraticTriangle& nodes : triangulation.triangles()) {
    mesh::Corners corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      mesh::NodeIndex& vertex = numbers.vertex_of_node[static_cast<std::size_t>(nodes[i])];
      if (vertex < 0) {
        vertex = static_cast<mesh::NodeIndex>(numbers.node_of_vertex.size());
        numbers.node_of_vertex.push_back(nodes[i]);
      }
      corners[i] = vertex;
    }
    numbers.triangles.push_back(corners);
  }
  return numbers;
}

Sparse stiffness(const VertexNumbers& numbers, const mesh::Positions& x) {
  std::vector<Eigen::Triplet<double, linalg::SparseIndex>> entries;
  entries.reserve(12 * numbers.triangles.size());
  for (const mesh::Corners& corners : numbers.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const mesh::NodeIndex a = corners[(i + 1) % 3];
      const mesh::NodeIndex b = corners[(i + 2) % 3];
      const Eigen::Vector3d to_a = x.row(a) - x.row(corners[i]);
      const Eigen::Vector3d to_b = x.row(b) - x.row(corners[i]);
      const double weight = 0.5 * to_a.dot(to_b) / to_a.cross(to_b).norm();
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
    }
  }
  Sparse matrix(x.rows(), x.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd vertex_areas(const VertexNumbers& numbers, const mesh::Positions& x) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(x.rows());
  for (const auto& [a, b, c] : numbers.triangles) {
    const Eigen::Vector3d ab = x.row(b) - x.row(a);
    const Eigen::Vector3d ac = x.row(c) - x.row(a);
    const double third = ab.cross(ac).norm() / 6;
    for (const mesh::NodeIndex vertex : {a, b, c}) areas[vertex] += third;
  }
  return areas;
}

linalg::SparseMatrix to_linalg(const Sparse& matrix) {
  const auto num_nonzeros = matrix.nonZeros();
  return {matrix.cols(),
          {matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1},
          {matrix.innerIndexPtr(), matrix.innerIndexPtr() + num_nonzeros},
          {matrix.valuePtr(), matrix.valuePtr() + num_nonzeros}};
}

}  // namespace vesica::paper
