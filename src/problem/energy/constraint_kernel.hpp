#pragma once

#include <array>
#include <vector>

#include "curvature_form.hpp"
#include "local_form.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/model/model.hpp"

namespace vesica::problem {

/// Values of the constrained functionals over an element, and their exact gradients with respect to
/// its nodal values.
template <class T>
struct ConstraintGradients {
  std::array<T, model::num_constraints> values{};
  std::array<std::array<Vec3<T>, 6>, model::num_constraints> dx{};
  std::array<std::array<T, 6>, model::num_constraints> dc{};
};

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

/// Calls visit(place, density) for the constraints without curvature that take part at a point. All
/// discrete functionals are functions of the positions and of c alone, so that (e) can be their
/// exact derivative; those that look at the curvature are distributional curvatures.
template <class T, class Visit>
void for_each_local_constraint(const model::Physics& physics, const model::LocalPoint<T>& point,
                               const Visit& visit) {
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    if constexpr (model::LocalTerm<Constraint>) {
      if (!model::takes_part<Constraint>(physics)) return;
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
    for_each_local_constraint(
        physics, local_point(in, frame),
        [&](std::size_t place, const model::LocalDensity<T>& f) { sum[place] += area * f.value; });
  }
  for_each_curved_constraint(physics, [&]<class Constraint>(std::size_t place) {
    sum[place] = curvature_integral<Constraint>(physics.material, nodes);
  });
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
    const T area = point.weight * frame.area_element;
    for_each_local_constraint(physics, at, [&](std::size_t place, const model::LocalDensity<T>& f) {
      sum.values[place] += area * f.value;
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
  for_each_curved_constraint(physics, [&]<class Constraint>(std::size_t place) {
    sum.values[place] = curvature_integral<Constraint>(physics.material, nodes);
    add_curvature_gradient<Constraint>(physics.material, 1.0, nodes, sum.dx[place], sum.dc[place]);
  });
  return sum;
}

/// Computes the constrained functionals of a surface, in the order of model::Constraints; those of
/// `order_parameter` need it, shape (N), and are left at 0 for an empty one. Sums over triangles
/// run in a fixed order.
inline std::array<double, model::num_constraints> constraint_values(
    const model::Physics& physics, const mesh::Triangulation& triangulation,
    const mesh::Positions& positions, const Eigen::VectorXd& order_parameter, int threads) {
  const auto directions = shared_directions(physics, triangulation, positions);
  std::vector<std::array<double, model::num_constraints>> elements(
      static_cast<std::size_t>(triangulation.num_triangles()));
  parallel_for(triangulation.num_triangles(), threads, [&](int begin, int end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      const auto& triangle = triangulation.triangles()[t];
      auto nodes = element_nodes(physics, positions, order_parameter, triangle);
      put_directions(directions, triangle, nodes);
      elements[t] = element_constraint_values(nodes, physics);
    }
  });
  std::array<double, model::num_constraints> sum{};
  for (const auto& element : elements) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += element[k];
  }
  return sum;
}

}  // namespace vesica::problem
