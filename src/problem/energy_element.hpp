#pragma once

#include <array>

#include "constraint_kernel.hpp"
#include "energy_kernel.hpp"
#include "gaussian_kernel.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/problem/energy_problem.hpp"

namespace vesica::problem {

/// Nodal values of one element.
struct EnergyElement {
  std::array<Vec3<double>, 6> x, p, velocity;
  std::array<double, 6> c{}, c_rate{};
  std::array<double, 6> vertex_angle{};
};

inline Vec3<double> row_of(const mesh::Positions& field, mesh::NodeIndex node) {
  return {field(node, 0), field(node, 1), field(node, 2)};
}

inline EnergyElement energy_element(const EnergyFields& fields, const EnergyRates& rates,
                                    const mesh::QuadraticTriangle& triangle) {
  EnergyElement element;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto node = triangle[i];
    element.x[i] = row_of(fields.positions, node);
    if (fields.moment.rows() > 0) element.p[i] = row_of(fields.moment, node);
    if (rates.velocity.rows() > 0) element.velocity[i] = row_of(rates.velocity, node);
    element.c[i] = fields.order_parameter.size() > 0 ? fields.order_parameter[node] : 1.0;
    if (rates.order_parameter.size() > 0) element.c_rate[i] = rates.order_parameter[node];
  }
  return element;
}

inline EnergyPoint<double> energy_point(const EnergyElement& element,
                                        const fem::ShapeValues& shape) {
  EnergyPoint<double> in;
  in.x = interpolate_nodes(element.x, shape.value);
  in.x_u = interpolate_nodes(element.x, shape.du);
  in.x_v = interpolate_nodes(element.x, shape.dv);
  in.p = interpolate_nodes(element.p, shape.value);
  in.p_u = interpolate_nodes(element.p, shape.du);
  in.p_v = interpolate_nodes(element.p, shape.dv);
  in.c = interpolate_nodes(element.c, shape.value);
  in.c_u = interpolate_nodes(element.c, shape.du);
  in.c_v = interpolate_nodes(element.c, shape.dv);
  return in;
}

/// Tells whether the Gauss curvature has to be integrated: 2 pi chi gives that of equal rigidities.
inline bool has_gaussian_term(const model::Physics& physics) {
  return physics.is_two_phase && physics.material.gaussian_rigidity.difference() != 0;
}

/// Returns the weight s_i = (k_g(c_i) - mean of the phases) of the Gauss curvature at a node. The
/// mean multiplies 2 pi chi.
template <class T>
T gaussian_weight(const model::Physics& physics, const T& c) {
  return (0.5 * physics.material.gaussian_rigidity.difference()) * model::phase_indicator(c);
}

/// Returns the derivative ds/dc of gaussian_weight.
template <class T>
T gaussian_weight_derivative(const model::Physics& physics, const T& c) {
  return (0.5 * physics.material.gaussian_rigidity.difference()) *
         model::phase_indicator_derivative(c);
}

inline std::array<double, 6> gaussian_weights(const model::Physics& physics,
                                              const EnergyElement& element) {
  std::array<double, 6> s{};
  for (std::size_t i = 0; i < 6; ++i) s[i] = gaussian_weight(physics, element.c[i]);
  return s;
}

inline GaussianPoint<double> gaussian_point(const EnergyElement& element,
                                            const std::array<double, 6>& s,
                                            const fem::ShapeValues& shape) {
  constexpr auto second = fem::shape_second_derivatives();
  return {interpolate_nodes(s, shape.value),        interpolate_nodes(element.x, shape.du),
          interpolate_nodes(element.x, shape.dv),   interpolate_nodes(element.x, second.duu),
          interpolate_nodes(element.x, second.duv), interpolate_nodes(element.x, second.dvv)};
}

/// Calls visit(shape functions, weight, term) at the interior points, edge points and corners of an
/// element, where term(point) is the integrand and its derivative for a GaussianPoint over any
/// number. The sum of weight * term with s = phi, plus the vertex angles, is int phi dK.
template <class Visit>
void for_each_gaussian_point(Visit&& visit) {
  static const auto edges = edge_rule();
  static const auto corners = corner_rule();
  for (const auto& point : fem::triangle_rule())
    visit(point.shape, point.weight, [](const auto& in) { return interior_curvature(in); });
  for (const auto& point : edges) {
    visit(point.shape, point.weight,
          [&](const auto& in) { return edge_curvature(in, point.direction); });
  }
  for (const auto& point : corners) {
    visit(point.shape, 1.0,
          [&](const auto& in) { return corner_angle(in, point.next, point.previous); });
  }
}

}  // namespace vesica::problem
