#pragma once

#include <Eigen/Core>

#include "vesica/problem/state.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::problem {

inline mesh::Surface capsule(int resolution) {
  shapes::ShapeOptions options;
  options.resolution = resolution;
  return shapes::make_shape(options);
}

inline mesh::Surface unit_sphere(int resolution) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.resolution = resolution;
  return shapes::make_shape(options);
}

inline mesh::Surface torus(double major_radius, double minor_radius, int resolution) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::torus;
  options.major_radius = major_radius;
  options.minor_radius = minor_radius;
  options.resolution = resolution;
  return shapes::make_shape(options);
}

inline mesh::Surface ellipsoid(const Eigen::Vector3d& semi_axes, int resolution) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::ellipsoid;
  options.semi_axes = semi_axes;
  options.resolution = resolution;
  return shapes::make_shape(options);
}

/// A state at rest; `order_parameter` may be empty.
inline State state_of(const mesh::Surface& surface, const Eigen::VectorXd& order_parameter = {}) {
  State state;
  state.triangulation = surface.triangulation;
  state.values.positions = surface.positions;
  state.values.mean_curvature = Eigen::VectorXd::Zero(surface.positions.rows());
  state.values.order_parameter = order_parameter;
  state.rates = state.values;
  state.rates.positions.setZero();
  state.rates.order_parameter.setZero();
  return state;
}

}  // namespace vesica::problem
