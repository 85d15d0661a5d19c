#pragma once

#include <numbers>
#include <vector>

#include "distributional_curvature.hpp"
#include "element_nodes.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::problem {

/// Calls visit.operator()<Constraint>(place) for the constraints that look at the curvature and
/// have a target. Free ones are left out, because their angles at the edges need the normals.
template <class Visit>
void for_each_curved_constraint(const model::Physics& physics, const Visit& visit) {
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    if constexpr (!model::LocalTerm<Constraint>) {
      static_assert(model::CurvatureTerm<Constraint>,
                    "a constraint needs add_to(), or a distributional curvature and its weight");
      if (!physics.is_free[place]) visit.template operator()<Constraint>(place);
    }
  });
}

/// Tells whether the elements need directions to count angles at edges from.
inline bool needs_directions(const model::Physics& physics) {
  bool is_needed = false;
  for_each_curved_constraint(physics, [&]<class>(std::size_t) { is_needed = true; });
  return is_needed;
}

/// Returns directions that all elements at a node share, the normals of the surface, shape (N, 3),
/// or an empty array where none are needed.
inline mesh::Positions shared_directions(const model::Physics& physics,
                                         const mesh::Triangulation& triangulation,
                                         const mesh::Positions& positions) {
  return needs_directions(physics) ? nodal_normals(triangulation, positions) : mesh::Positions{};
}

/// Puts the shared directions into the nodes of an element.
template <class T>
void put_directions(const mesh::Positions& directions, const mesh::QuadraticTriangle& triangle,
                    ElementNodes<T>& nodes) {
  if (directions.rows() == 0) return;
  for (std::size_t i = 0; i < 6; ++i) nodes.normal[i] = row_of(directions, triangle[i]);
}

template <class Term, class T>
std::array<T, 6> curvature_weights(const model::Material& material, const ElementNodes<T>& nodes) {
  std::array<T, 6> s{};
  for (std::size_t i = 0; i < 6; ++i) s[i] = Term::curvature_weight(material, nodes.c[i]);
  return s;
}

template <class T>
CurvaturePoint<T> curvature_point(const ElementNodes<T>& nodes, const std::array<T, 6>& s,
                                  const fem::ShapeValues& shape) {
  constexpr auto second = fem::shape_second_derivatives();
  return {interpolate_nodes(s, shape.value),           interpolate_nodes(nodes.x, shape.du),
          interpolate_nodes(nodes.x, shape.dv),        interpolate_nodes(nodes.x, second.duu),
          interpolate_nodes(nodes.x, second.duv),      interpolate_nodes(nodes.x, second.dvv),
          interpolate_nodes(nodes.normal, shape.value)};
}

/// Calls visit(shape functions, weight, integrand) at the points of an element where it has a
/// distributional curvature. The Gauss curvature: inside the element, along its edges and at its
/// corners; the sum of weight * integrand with s = phi, plus the vertex angles, is int phi dK. The
/// mean curvature: inside and along the edges; the sum is int phi dkappa.
template <model::Curvature kind, class Visit>
void for_each_curvature_point(Visit&& visit) {
  static const auto edges = edge_rule();
  static const auto corners = corner_rule();
  constexpr bool is_gauss = kind == model::Curvature::gauss;
  for (const auto& point : fem::triangle_rule()) {
    visit(point.shape, point.weight, [](const auto& in) {
      return is_gauss ? interior_gauss_curvature(in) : interior_mean_curvature(in);
    });
  }
  for (const auto& point : edges) {
    visit(point.shape, point.weight, [&](const auto& in) {
      return is_gauss ? geodesic_curvature(in, point.direction) : edge_angle(in, point.direction);
    });
  }
  if constexpr (is_gauss) {
    for (const auto& point : corners) {
      visit(point.shape, 1.0,
            [&](const auto& in) { return corner_angle(in, point.next, point.previous); });
    }
  }
}

/// Computes a term sum_i s(c_i) int phi_i dK (or dkappa) over one element.
template <class Term, class T>
T curvature_integral(const model::Material& material, const ElementNodes<T>& nodes) {
  const auto s = curvature_weights<Term>(material, nodes);
  T sum{};
  if constexpr (Term::curvature == model::Curvature::gauss)
    sum = interpolate_nodes(s, nodes.vertex_angle);
  for_each_curvature_point<Term::curvature>(
      [&](const fem::ShapeValues& shape, double weight, const auto& integrand) {
        sum += weight * integrand(curvature_point(nodes, s, shape)).value;
      });
  return sum;
}

/// Adds `factor` times the derivative of `curvature_integral` with respect to the nodal values.
template <class Term, class T>
void add_curvature_gradient(const model::Material& material, double factor,
                            const ElementNodes<T>& nodes, std::array<Vec3<T>, 6>& dx,
                            std::array<T, 6>& dc) {
  constexpr auto second = fem::shape_second_derivatives();
  const auto s = curvature_weights<Term>(material, nodes);
  std::array<T, 6> by_weight{};
  if constexpr (Term::curvature == model::Curvature::gauss) {
    for (std::size_t i = 0; i < 6; ++i) by_weight[i] = nodes.vertex_angle[i];
  }
  for_each_curvature_point<Term::curvature>(
      [&](const fem::ShapeValues& shape, double weight, const auto& integrand) {
        const auto g = integrand(curvature_point(nodes, s, shape)).gradient;
        for (std::size_t i = 0; i < 6; ++i) {
          dx[i] = dx[i] + (factor * weight) *
                              (shape.du[i] * g.x_u + shape.dv[i] * g.x_v + second.duu[i] * g.x_uu +
                               second.duv[i] * g.x_uv + second.dvv[i] * g.x_vv);
          by_weight[i] += (weight * shape.value[i]) * g.s;
        }
      });
  for (std::size_t i = 0; i < 6; ++i)
    dc[i] += factor * by_weight[i] * Term::curvature_weight_derivative(material, nodes.c[i]);
}

/// Tells whether an energy has a distributional form: a constant rigidity gives 2 pi chi instead.
template <class Energy>
bool has_curvature_form(const model::Physics& physics) {
  return physics.is_two_phase && !Energy::is_topological(physics.material);
}

/// Takes the nodes of an element out of the fields; c = 1 in a single-phase vesicle.
inline ElementNodes<double> element_nodes(const model::Physics& physics,
                                          const mesh::Positions& positions,
                                          const Eigen::VectorXd& order_parameter,
                                          const mesh::QuadraticTriangle& triangle) {
  ElementNodes<double> nodes;
  for (std::size_t i = 0; i < 6; ++i) {
    nodes.x[i] = row_of(positions, triangle[i]);
    nodes.c[i] = physics.is_two_phase ? order_parameter[triangle[i]] : 1;
  }
  return nodes;
}

/// Returns 2 pi over the number of elements at each vertex, 0 at mid-edge nodes, shape (N).
inline Eigen::VectorXd vertex_angles(const mesh::Triangulation& triangulation) {
  Eigen::VectorXd count = Eigen::VectorXd::Zero(triangulation.num_nodes());
  for (const auto& triangle : triangulation.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) count[triangle[i]] += 1;
  }
  return count.unaryExpr([](double n) { return n > 0 ? 2 * std::numbers::pi / n : 0.0; });
}

/// Computes an energy int k(c) K [energy]: its constant part times 2 pi chi, which is exact, and
/// sum_i s(c_i) int phi_i dK. Sums over triangles run in a fixed order.
template <class Energy>
double curvature_energy(const model::Physics& physics, const mesh::Triangulation& triangulation,
                        const Eigen::VectorXd& angles, const mesh::Positions& positions,
                        const Eigen::VectorXd& order_parameter, int threads) {
  double sum = Energy::topological_rigidity(physics.material, physics.is_two_phase) * 2 *
               std::numbers::pi * triangulation.euler_characteristic();
  if (!has_curvature_form<Energy>(physics)) return sum;
  std::vector<double> parts(static_cast<std::size_t>(triangulation.num_triangles()));
  parallel_for(triangulation.num_triangles(), threads, [&](int begin, int end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      const auto& triangle = triangulation.triangles()[t];
      auto nodes = element_nodes(physics, positions, order_parameter, triangle);
      for (std::size_t i = 0; i < 6; ++i) nodes.vertex_angle[i] = angles[triangle[i]];
      parts[t] = curvature_integral<Energy>(physics.material, nodes);
    }
  });
  for (const double part : parts) sum += part;
  return sum;
}

/// Calls visit.operator()<Term>(factor) for the energies, with factor 1, and the constraints, with
/// their multipliers, that enter the discrete Lagrangian by a distributional curvature.
template <class Visit>
void for_each_curvature_term(const model::Physics& physics,
                             const std::array<double, model::num_constraints>& multipliers,
                             const Visit& visit) {
  model::for_each_term<model::Energies>([&]<class Energy>(std::size_t) {
    if constexpr (model::CurvatureTerm<Energy>) {
      if (has_curvature_form<Energy>(physics)) visit.template operator()<Energy>(1.0);
    }
  });
  for_each_curved_constraint(physics, [&]<class Constraint>(std::size_t place) {
    visit.template operator()<Constraint>(multipliers[place]);
  });
}

}  // namespace vesica::problem
