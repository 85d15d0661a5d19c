#pragma once

#include <utility>

#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// A quadrature point on the surface of a state.
struct SurfaceSample {
  const mesh::QuadraticTriangle& triangle;
  const fem::ShapeValues& shape;
  fem::TangentFrame<double> frame;
  double weight;  ///< quadrature weight times area element
};

/// Calls visit(sample) at all quadrature points, triangle by triangle.
template <class Visit>
void for_each_point(const mesh::Triangulation& triangulation, const mesh::Positions& positions,
                    Visit&& visit) {
  for (const auto& triangle : triangulation.triangles()) {
    for (const auto& point : fem::triangle_rule()) {
      const auto frame =
          fem::tangent_frame(fem::to_vec3(fem::combine<3>(positions, triangle, point.shape.du)),
                             fem::to_vec3(fem::combine<3>(positions, triangle, point.shape.dv)));
      visit(SurfaceSample{triangle, point.shape, frame, point.weight * frame.area_element});
    }
  }
}

template <class Visit>
void for_each_point(const State& state, Visit&& visit) {
  for_each_point(*state.triangulation, state.values.positions, std::forward<Visit>(visit));
}

/// Value of a nodal scalar at a sample.
inline double scalar_at(const Eigen::VectorXd& field, const SurfaceSample& sample) {
  return fem::combine<1>(field, sample.triangle, sample.shape.value)[0];
}

/// Surface gradient of a nodal scalar at a sample.
inline Vec3<double> gradient_at(const Eigen::VectorXd& field, const SurfaceSample& sample) {
  return fem::surface_gradient(sample.frame,
                               fem::combine<1>(field, sample.triangle, sample.shape.du)[0],
                               fem::combine<1>(field, sample.triangle, sample.shape.dv)[0]);
}

/// Value of a nodal vector, shape (N, 3), at a sample.
inline Vec3<double> vector_at(const mesh::Positions& field, const SurfaceSample& sample) {
  return fem::to_vec3(fem::combine<3>(field, sample.triangle, sample.shape.value));
}

}  // namespace vesica::problem
