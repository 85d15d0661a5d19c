#pragma once

#include <Eigen/Core>

#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::fem {

/// A quadrature point on a surface.
struct SurfaceSample {
  const mesh::QuadraticTriangle& triangle;
  const ShapeValues& shape;
  TangentFrame<double> frame;
  double weight;  ///< quadrature weight times area element
};

/// Calls visit(sample) at the quadrature points of one triangle.
template <class Visit>
void for_each_point(const mesh::QuadraticTriangle& triangle, const mesh::Positions& positions,
                    Visit&& visit) {
  for (const auto& point : triangle_rule()) {
    const auto frame = tangent_frame(to_vec3(combine<3>(positions, triangle, point.shape.du)),
                                     to_vec3(combine<3>(positions, triangle, point.shape.dv)));
    visit(SurfaceSample{triangle, point.shape, frame, point.weight * frame.area_element});
  }
}

/// Calls visit(sample) at all quadrature points, triangle by triangle.
template <class Visit>
void for_each_point(const mesh::Triangulation& triangulation, const mesh::Positions& positions,
                    Visit&& visit) {
  for (const auto& triangle : triangulation.triangles()) for_each_point(triangle, positions, visit);
}

/// Returns the value of a nodal scalar at a sample.
inline double scalar_at(const Eigen::VectorXd& field, const SurfaceSample& sample) {
  return combine<1>(field, sample.triangle, sample.shape.value)[0];
}

/// Returns the surface gradient of a nodal scalar at a sample.
inline Vec3<double> gradient_at(const Eigen::VectorXd& field, const SurfaceSample& sample) {
  return surface_gradient(sample.frame, combine<1>(field, sample.triangle, sample.shape.du)[0],
                          combine<1>(field, sample.triangle, sample.shape.dv)[0]);
}

/// Returns the value of a nodal vector, shape (N, 3), at a sample.
inline Vec3<double> vector_at(const mesh::Positions& field, const SurfaceSample& sample) {
  return to_vec3(combine<3>(field, sample.triangle, sample.shape.value));
}

}  // namespace vesica::fem
