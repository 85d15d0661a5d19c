#include "vesica/problem/normal_graph.hpp"

#include "rigid_modes.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/linalg/dense.hpp"

namespace vesica::problem {

namespace {

/// A rigid motion whose normal velocity is this small, relative to the largest, squared, does not
/// move the shape but only its mesh.
constexpr double negligible_mode = 1e-4;

using Gauge = Eigen::Matrix<double, Eigen::Dynamic, 6>;

Gauge rigid_gauge(const mesh::Triangulation& triangulation, const mesh::Positions& positions) {
  const auto centre = centroid(triangulation, positions);
  Gauge moments = Gauge::Zero(positions.rows(), 6);
  RigidGram gram = RigidGram::Zero();
  fem::for_each_point(triangulation, positions, [&](const fem::SurfaceSample& sample) {
    const auto modes = rigid_modes(fem::vector_at(positions, sample), centre, sample.frame.normal);
    gram += sample.weight * modes * modes.transpose();
    for (std::size_t i = 0; i < 6; ++i) {
      moments.row(sample.triangle[i]) += sample.weight * sample.shape.value[i] * modes.transpose();
    }
  });
  const auto eigen = linalg::symmetric_eigensystem(gram);
  Gauge gauge = moments * eigen.vectors;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double value = eigen.values[k];
    if (value > negligible_mode * eigen.values[5]) {
      gauge.col(k) /= std::sqrt(value);
    } else {
      gauge.col(k).setZero();
    }
  }
  return gauge;
}

}  // namespace

mesh::Positions NormalGraph::positions(const Eigen::VectorXd& displacements) const {
  return reference + displacements.asDiagonal() * directions;
}

double NormalGraph::smallest_cosine(const mesh::Triangulation& triangulation,
                                    const Eigen::VectorXd& displacements) const {
  return nodal_normals(triangulation, positions(displacements))
      .cwiseProduct(directions)
      .rowwise()
      .sum()
      .minCoeff();
}

NormalGraph make_normal_graph(const mesh::Triangulation& triangulation,
                              const mesh::Positions& positions) {
  return {positions, nodal_normals(triangulation, positions),
          rigid_gauge(triangulation, positions)};
}

mesh::Positions nodal_normals(const mesh::Triangulation& triangulation,
                              const mesh::Positions& positions) {
  mesh::Positions normals = mesh::Positions::Zero(positions.rows(), 3);
  fem::for_each_point(triangulation, positions, [&](const fem::SurfaceSample& sample) {
    const auto& normal = sample.frame.normal;
    for (std::size_t i = 0; i < 6; ++i) {
      const double weight = sample.weight * sample.shape.value[i] * sample.shape.value[i];
      normals.row(sample.triangle[i]) += weight * Eigen::RowVector3d(normal.x, normal.y, normal.z);
    }
  });
  normals.rowwise().normalize();
  return normals;
}

}  // namespace vesica::problem
