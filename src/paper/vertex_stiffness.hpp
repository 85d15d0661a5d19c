#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "vesica/linalg/sparse_matrix.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::paper {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, linalg::SparseIndex>;

/// The corners of a triangulation, numbered by themselves.
struct VertexNumbers {
  std::vector<mesh::NodeIndex> node_of_vertex;
  std::vector<mesh::NodeIndex> vertex_of_node;  ///< -1 for mid-edge nodes
  std::vector<mesh::Corners> triangles;         ///< of vertices
};

[[nodiscard]] VertexNumbers vertex_numbers(const mesh::Triangulation& triangulation);

/// int grad phi_i . grad phi_j on the flat triangles, phi linear: half the sum of the cotangents
/// opposite the edge, with minus for i != j. `x`: positions of the vertices.
[[nodiscard]] Sparse stiffness(const VertexNumbers& numbers, const mesh::Positions& x);

/// A third of the area of the flat triangles around each vertex [length^2].
[[nodiscard]] Eigen::VectorXd vertex_areas(const VertexNumbers& numbers, const mesh::Positions& x);

[[nodiscard]] linalg::SparseMatrix to_linalg(const Sparse& matrix);

}  // namespace vesica::paper
