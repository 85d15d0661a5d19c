#pragma once

#include <array>

#include "local_form.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/model/model.hpp"

namespace vesica::problem {

/// Positions and order parameter of the six nodes of an element.
template <class T>
struct ElementNodes {
  std::array<Vec3<T>, 6> x;
  std::array<T, 6> c;
};

/// Exact gradients of the constrained functionals with respect to the nodal values of an element.
template <class T>
struct ConstraintGradients {
  std::array<std::array<Vec3<T>, 6>, model::num_constraints> dx{};
  std::array<std::array<T, 6>, model::num_constraints> dc{};
};

/// Interpolates nodal values of an element, scalars or vectors, with the weights of the nodes.
template <class V>
V interpolate_nodes(const std::array<V, 6>& nodes, const std::array<double, 6>& weights) {
  V sum = weights[0] * nodes[0];
  for (std::size_t i = 1; i < 6; ++i) sum = sum + weights[i] * nodes[i];
  return sum;
}

template <class T>
PointFields<T> point_fields(const ElementNodes<T>& nodes, const fem::ShapeValues& shape,
                            bool is_two_phase) {
  PointFields<T> in;
  in.x = interpolate_nodes(nodes.x, shape.value);
  in.x_u = interpolate_nodes(nodes.x, shape.du);
  in.x_v = interpolate_nodes(nodes.x, shape.dv);
  in.c = is_two_phase ? interpolate_nodes(nodes.c, shape.value) : T(1.0);
  return in;
}

/// Calls visit.operator()<Constraint>(place, density) for the constraints that take part at a
/// point. Their discrete functionals are functions of the positions and of c alone, so that (e) can
/// be their exact derivative.
template <class T, class Visit>
void for_each_constraint(const model::Physics& physics, const model::LocalPoint<T>& point,
                         const Visit& visit) {
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    static_assert(model::LocalTerm<Constraint>,
                  "a constraint needs add_to(): a density that does not look at the curvature");
    if (model::takes_part<Constraint>(physics)) {
      model::LocalDensity<T> f;
      Constraint::add_to(physics.material, point, 1.0, f);
      visit(place, f);
    }
  });
}

/// Computes the constrained functionals over one element; with T = Dual<1>, also their rates.
template <class T>
std::array<T, model::num_constraints> element_constraint_values(const ElementNodes<T>& nodes,
                                                                const model::Physics& physics) {
  std::array<T, model::num_constraints> sum{};
  for (const auto& point : fem::triangle_rule()) {
    const auto in = point_fields(nodes, point.shape, physics.is_two_phase);
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const T area = point.weight * frame.area_element;
    for_each_constraint(
        physics, local_point(in, frame),
        [&](std::size_t place, const model::LocalDensity<T>& f) { sum[place] += area * f.value; });
  }
  return sum;
}

template <class T>
ConstraintGradients<T> element_constraint_gradients(const ElementNodes<T>& nodes,
                                                    const model::Physics& physics) {
  ConstraintGradients<T> sum;
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = point_fields(nodes, shape, physics.is_two_phase);
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const auto at = local_point(in, frame);
    for_each_constraint(physics, at, [&](std::size_t place, const model::LocalDensity<T>& f) {
      const auto d = derivative_of(f, at, in, frame, physics.is_two_phase);
      for (std::size_t i = 0; i < 6; ++i) {
        const double value = point.weight * shape.value[i];
        const double du = point.weight * shape.du[i];
        const double dv = point.weight * shape.dv[i];
        sum.dx[place][i] = sum.dx[place][i] + value * d.x + du * d.x_u + dv * d.x_v;
        if (physics.is_two_phase)
          sum.dc[place][i] = sum.dc[place][i] + value * d.c + du * d.c_u + dv * d.c_v;
      }
    });
  }
  return sum;
}

}  // namespace vesica::problem
