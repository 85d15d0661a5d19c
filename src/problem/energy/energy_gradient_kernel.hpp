#pragma once

#include "element_packs.hpp"

namespace vesica::problem {

/// Derivative at the nodes of a pack of elements, shape (6, 7): x, p, c.
using GradientTable = std::array<Pack, 42>;
/// Equations of the moment at the nodes: shape (6, 3), and int phi_i phi_j / k, shape (6, 6).
using MomentTable = std::array<Pack, 18>;
using MassTable = std::array<Pack, 36>;

/// Adds the derivative of E_h + sum lambda_i C_i with the terms of the flow, without the Gaussian
/// term; with T = PackDual its change. Rows of p only when they are asked for.
template <class T>
void add_energy_gradient(const model::Physics& physics, const Multipliers& multipliers,
                         const ElementFields<T>& element, bool with_moment, GradientTable& table) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = energy_point(element, shape);
    auto out = energy_point_gradient(physics, multipliers, in);
    add_flow_terms(physics, interpolate_nodes(element.velocity, shape.value),
                   interpolate_nodes(element.c_rate, shape.value), in, out);
    const Pack weight(point.weight);
    const auto x = weight * summand(out.x);
    const auto x_u = weight * summand(out.x_u);
    const auto x_v = weight * summand(out.x_v);
    const auto c = weight * summand(out.c);
    const auto c_u = weight * summand(out.c_u);
    const auto c_v = weight * summand(out.c_v);
    for (std::size_t i = 0; i < 6; ++i) {
      add(test_with(shape, i, x, x_u, x_v), &table[7 * i]);
      table[7 * i + 6] += test_with(shape, i, c, c_u, c_v);
    }
    if (!with_moment) continue;
    const auto p = weight * summand(out.p);
    const auto p_u = weight * summand(out.p_u);
    const auto p_v = weight * summand(out.p_v);
    for (std::size_t i = 0; i < 6; ++i) add(test_with(shape, i, p, p_u, p_v), &table[7 * i + 3]);
  }
}

/// Adds the derivative of the energies and constraints that are distributional curvatures; with T =
/// PackDual its change.
template <class T>
void add_curvature_terms(const model::Physics& physics, const Multipliers& multipliers,
                         const ElementFields<T>& element, GradientTable& table) {
  for_each_curvature_term(physics, multipliers, [&]<class Term>(double factor) {
    std::array<Vec3<T>, 6> dx{};
    std::array<T, 6> dc{};
    add_curvature_gradient<Term, T>(physics.material, factor, element, dx, dc);
    for (std::size_t i = 0; i < 6; ++i) {
      add(summand(dx[i]), &table[7 * i]);
      table[7 * i + 6] += summand(dc[i]);
    }
  });
}

/// Adds dE_h/dp of a pack of elements; with T = PackDual its change.
template <class T>
void add_moment_equations(const model::Physics& physics, const ElementFields<T>& element,
                          MomentTable& table) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    EnergyPoint<T> in;
    in.x_u = interpolate_nodes(element.x, shape.du);
    in.x_v = interpolate_nodes(element.x, shape.dv);
    in.p = interpolate_nodes(element.p, shape.value);
    in.c = interpolate_nodes(element.c, shape.value);
    EnergyPoint<T> out;
    put_moment_derivative(physics, in, fem::tangent_frame(in.x_u, in.x_v), out);
    const Pack weight(point.weight);
    const auto p = weight * summand(out.p);
    const auto p_u = weight * summand(out.p_u);
    const auto p_v = weight * summand(out.p_v);
    for (std::size_t i = 0; i < 6; ++i) add(test_with(shape, i, p, p_u, p_v), &table[3 * i]);
  }
}

/// Adds int phi_i phi_j / k_kappa(c) of a pack of elements.
inline void add_moment_mass(const model::Physics& physics, const ElementFields<Pack>& element,
                            MassTable& table) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto n =
        cross(interpolate_nodes(element.x, shape.du), interpolate_nodes(element.x, shape.dv));
    const Pack density = point.weight * norm(n) /
                         model::interpolate(physics.material.bending_rigidity,
                                            interpolate_nodes(element.c, shape.value));
    for (std::size_t i = 0; i < 6; ++i) {
      const Pack row = shape.value[i] * density;
      for (std::size_t j = 0; j < 6; ++j) table[6 * i + j] += shape.value[j] * row;
    }
  }
}

}  // namespace vesica::problem
