#pragma once

#include <array>

#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::problem {

/// Positions and order parameter of the six nodes of an element.
template <class T>
struct ElementNodes {
  std::array<Vec3<T>, 6> x;
  std::array<T, 6> c;
};

/// Exact gradients of volume, area and phase difference with respect to the nodal values of an
/// element.
template <class T>
struct ConstraintGradients {
  std::array<std::array<Vec3<T>, 6>, 3> dx{};
  std::array<T, 6> dc{};  ///< of the phase difference; the others do not depend on c
};

template <class T>
Vec3<T> interpolate_nodes(const std::array<Vec3<T>, 6>& nodes,
                          const std::array<double, 6>& weights) {
  Vec3<T> sum = weights[0] * nodes[0];
  for (std::size_t i = 1; i < 6; ++i) sum = sum + weights[i] * nodes[i];
  return sum;
}

template <class T>
T interpolate_nodes(const std::array<T, 6>& nodes, const std::array<double, 6>& weights) {
  T sum = weights[0] * nodes[0];
  for (std::size_t i = 1; i < 6; ++i) sum = sum + weights[i] * nodes[i];
  return sum;
}

/// Volume, area and phase difference of one element; with T = Dual<1>, also their rates.
template <class T>
std::array<T, 3> element_constraint_values(const ElementNodes<T>& nodes, bool is_two_phase) {
  std::array<T, 3> sum{};
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const Vec3<T> normal = point.weight * cross(interpolate_nodes(nodes.x, shape.du),
                                                interpolate_nodes(nodes.x, shape.dv));
    const T area = norm(normal);
    sum[0] += (1.0 / 3) * dot(interpolate_nodes(nodes.x, shape.value), normal);
    sum[1] += area;
    if (is_two_phase)
      sum[2] += area * model::phase_indicator(interpolate_nodes(nodes.c, shape.value));
  }
  return sum;
}

/// The gradient of the volume is int phi_i nu, which is exact for the closed surface as a whole:
/// the boundary terms of neighbouring elements cancel, and the rule integrates both forms exactly.
template <class T>
ConstraintGradients<T> element_constraint_gradients(const ElementNodes<T>& nodes,
                                                    bool is_two_phase) {
  ConstraintGradients<T> sum;
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto frame = fem::tangent_frame(interpolate_nodes(nodes.x, shape.du),
                                          interpolate_nodes(nodes.x, shape.dv));
    const T area = point.weight * frame.area_element;
    const Vec3<T> oriented = area * frame.normal;
    const T c = is_two_phase ? interpolate_nodes(nodes.c, shape.value) : T(0.0);
    const T h = model::phase_indicator(c);
    const T h_prime = model::phase_indicator_derivative(c);
    for (std::size_t i = 0; i < 6; ++i) {
      const Vec3<T> gradient = area * fem::surface_gradient(frame, shape.du[i], shape.dv[i]);
      sum.dx[0][i] = sum.dx[0][i] + shape.value[i] * oriented;
      sum.dx[1][i] = sum.dx[1][i] + gradient;
      if (!is_two_phase) continue;
      sum.dx[2][i] = sum.dx[2][i] + h * gradient;
      sum.dc[i] = sum.dc[i] + shape.value[i] * (area * h_prime);
    }
  }
  return sum;
}

}  // namespace vesica::problem
