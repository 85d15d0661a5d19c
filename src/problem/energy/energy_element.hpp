#pragma once

#include <array>

#include "constraint_kernel.hpp"
#include "energy_kernel.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/problem/energy_problem.hpp"

namespace vesica::problem {

/// Nodal values of one element, or of as many as a number of type T stands for.
template <class T>
struct ElementFields : ElementNodes<T> {
  std::array<Vec3<T>, 6> p, velocity;
  std::array<T, 6> c_rate{};
};
using EnergyElement = ElementFields<double>;

/// What the distributional curvatures need from the mesh around an element.
struct Surroundings {
  const Eigen::VectorXd& vertex_angles;
  mesh::Positions directions{};  ///< as from shared_directions
};

/// Takes the values of an element out of the fields; arrays without rows give zeros.
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

/// The same with what is around the element.
inline EnergyElement energy_element(const EnergyFields& fields, const EnergyRates& rates,
                                    const mesh::QuadraticTriangle& triangle,
                                    const Surroundings& around) {
  auto element = energy_element(fields, rates, triangle);
  put_directions(around.directions, triangle, element);
  for (std::size_t i = 0; i < 6; ++i) element.vertex_angle[i] = around.vertex_angles[triangle[i]];
  return element;
}

template <class T>
EnergyPoint<T> energy_point(const ElementFields<T>& element, const fem::ShapeValues& shape) {
  EnergyPoint<T> in;
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

}  // namespace vesica::problem
