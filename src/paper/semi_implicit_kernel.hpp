#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "problem/element_equations.hpp"
#include "vesica/model/two_phase.hpp"
#include "vesica/paper/semi_implicit_problem.hpp"

namespace vesica::paper {

/// Integrals over an element for a pair of nodes; all are symmetric in the two nodes.
namespace pair {
inline constexpr std::size_t stiffness = 0;   ///< int grad phi_i . grad phi_j, entry of A
inline constexpr std::size_t mass = 1;        ///< int phi_i phi_j, entry of M
inline constexpr std::size_t bending = 2;     ///< tau C
inline constexpr std::size_t phase = 3;       ///< I = eps omega M + tau J
inline constexpr std::size_t normal = 4;      ///< int nu phi_i phi_j, entries of N
inline constexpr std::size_t tangential = 7;  ///< T_1 (3) and T_2 (3), or int P phi_i phi_j (6)
inline constexpr std::size_t count = 13;
}  // namespace pair

/// Integrals over an element for one node: the right-hand sides of (A.1).
namespace side {
inline constexpr std::size_t geometry = 0;     ///< x (3), kappa, beta_1, beta_2
inline constexpr std::size_t constraints = 6;  ///< l, k, h
inline constexpr std::size_t phase = constraints + model::num_constraints;  ///< s
inline constexpr std::size_t phase_constraints = phase + 1;
inline constexpr std::size_t count = phase_constraints + model::num_constraints;
}  // namespace side

inline constexpr std::size_t num_node_pairs = 21;  ///< of an element, i <= j

/// Number of the pair (i, j) = (j, i) within an element.
constexpr std::size_t pair_index(std::size_t i, std::size_t j) {
  const std::size_t low = std::min(i, j);
  return low * (11 - low) / 2 + std::max(i, j);
}

using PairIntegrals = std::array<std::array<double, pair::count>, num_node_pairs>;
using NodeIntegrals = std::array<std::array<double, side::count>, 6>;

/// What the element loop of one step reads.
struct SemiImplicitContext {
  problem::PointSettings point;
  const fem::NodalShapeOperator& shape_operator;
  const problem::Fields& fields;
  double time_step;
  double tangential_scale;  ///< sqrt(alpha/tau) with tangential fields, alpha/tau without
  TangentialVelocity tangential;
};

inline problem::ElementValues element_values(const problem::Fields& fields,
                                             const mesh::QuadraticTriangle& triangle) {
  problem::ElementValues element;
  const bool is_two_phase = fields.order_parameter.size() > 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto node = triangle[i];
    for (int k = 0; k < 3; ++k)
      element.value[i][static_cast<std::size_t>(k)] = fields.positions(node, k);
    element.value[i][3] = fields.mean_curvature[node];
    element.value[i][4] = is_two_phase ? fields.order_parameter[node] : 1;
  }
  return element;
}

/// Factors of phi_i phi_j and of grad phi_i . grad phi_j in the pair integrals at a point.
struct PairWeights {
  std::array<double, pair::count> value{};
  std::array<double, 4> gradient{};
};

/// Orthonormal tangential frame of 3.4: tau_1 along the surface gradient of the barycentric
/// coordinate u, tau_2 = nu x tau_1.
struct TangentPair {
  Vec3<double> first;
  Vec3<double> second;
};

inline TangentPair tangent_pair(const fem::TangentFrame<double>& frame) {
  const auto first = (1 / norm(frame.dual_u)) * frame.dual_u;
  return {first, cross(frame.normal, first)};
}

inline PairWeights pair_weights(const SemiImplicitContext& context,
                                const problem::PointInputs<double>& in,
                                const fem::TangentFrame<double>& frame) {
  const auto& material = context.point.physics.material;
  const double tau = context.time_step;
  const double k = model::interpolate(material.bending_rigidity, in.c);
  const double difference = in.kappa - model::interpolate(material.spontaneous_curvature, in.c);
  const double sigma_eps = material.line_tension * material.interface_width;
  const double convex = std::max(in.c * in.c - 1, 0.0);  // psi' = 2c(c^2-1)^+ - 2c(1-c^2)^+
  PairWeights weights;
  weights.gradient = {1, 0, tau * k, tau * sigma_eps};
  weights.value[pair::mass] = 1;
  weights.value[pair::bending] = tau * 0.5 * k * difference * difference;
  weights.value[pair::phase] = problem::phase_mobility(context.point.physics) +
                               tau * material.line_tension / material.interface_width * 2 * convex;
  const auto& n = frame.normal;
  double* normal = &weights.value[pair::normal];
  normal[0] = n.x;
  normal[1] = n.y;
  normal[2] = n.z;
  double* tangential = &weights.value[pair::tangential];
  if (context.tangential == TangentialVelocity::fields) {
    const auto [first, second] = tangent_pair(frame);
    const std::array<double, 6> t{first.x, first.y, first.z, second.x, second.y, second.z};
    std::copy(t.begin(), t.end(), tangential);
  } else {
    const std::array<double, 6> projection{1 - n.x * n.x, 1 - n.y * n.y, 1 - n.z * n.z,
                                           -n.x * n.y,    -n.y * n.z,    -n.x * n.z};
    std::copy(projection.begin(), projection.end(), tangential);
  }
  return weights;
}

inline void add_pair_integrals(const PairWeights& weights, const fem::TangentFrame<double>& frame,
                               const fem::QuadraturePoint& point, PairIntegrals& sum) {
  const auto& shape = point.shape;
  const double area = point.weight * frame.area_element;
  const double uu = area * dot(frame.dual_u, frame.dual_u);
  const double uv = area * dot(frame.dual_u, frame.dual_v);
  const double vv = area * dot(frame.dual_v, frame.dual_v);
  std::size_t index = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const double along_u = uu * shape.du[i] + uv * shape.dv[i];
    const double along_v = uv * shape.du[i] + vv * shape.dv[i];
    for (std::size_t j = i; j < 6; ++j) {
      const double product = area * shape.value[i] * shape.value[j];
      const double gradient = along_u * shape.du[j] + along_v * shape.dv[j];
      auto& entry = sum[index++];
      for (std::size_t k = 0; k < pair::count; ++k) entry[k] += product * weights.value[k];
      for (std::size_t k = 0; k < 4; ++k) entry[k] += gradient * weights.gradient[k];
    }
  }
}

/// Integrand of a right-hand side: factors of (phi_i, d phi_i/du, d phi_i/dv).
using Integrand = std::array<double, 3>;

/// Integrand of  value phi_i + vector . grad phi_i,  times the area element.
inline Integrand integrand(const fem::TangentFrame<double>& frame, double value,
                           const Vec3<double>& vector) {
  return {frame.area_element * value, frame.area_element * dot(vector, frame.dual_u),
          frame.area_element * dot(vector, frame.dual_v)};
}

/// b^m and s^m of (A.1b). -tau <dF, .> at the old fields, minus what the implicit forms C and J
/// make of the old kappa and c, is tau B and tau S of 2.4.
inline void put_explicit_sides(const SemiImplicitContext& context,
                               const problem::PointInputs<double>& in,
                               const fem::TangentFrame<double>& frame,
                               const model::SurfacePoint<double>& surface,
                               const PairWeights& weights,
                               std::array<Integrand, side::count>& out) {
  const auto variation = problem::lagrangian_variation(context.point, surface);
  const double tau = context.time_step;
  out[side::geometry + 3] = integrand(
      frame,
      dot(surface.position, frame.normal) - tau * variation.a -
          weights.value[pair::bending] * in.kappa,
      -tau * variation.b - weights.gradient[pair::bending] * surface.mean_curvature_gradient);
  out[side::phase] = integrand(
      frame, weights.value[pair::phase] * in.c - tau * variation.s,
      weights.gradient[pair::phase] * surface.order_parameter_gradient - tau * variation.q);
}

/// t_mu of (A.1b) or, where beta is eliminated, alpha/tau P x in the rows of x.
inline void put_tangential_sides(const SemiImplicitContext& context, const Vec3<double>& x,
                                 const fem::TangentFrame<double>& frame,
                                 std::array<Integrand, side::count>& out) {
  const double scale = context.tangential_scale * frame.area_element;
  if (context.tangential == TangentialVelocity::fields) {
    const auto [first, second] = tangent_pair(frame);
    out[side::geometry + 4][0] = scale * dot(first, x);
    out[side::geometry + 5][0] = scale * dot(second, x);
    return;
  }
  const auto projected = scale * (x - dot(x, frame.normal) * frame.normal);
  out[side::geometry][0] = projected.x;
  out[side::geometry + 1][0] = projected.y;
  out[side::geometry + 2][0] = projected.z;
}

/// l, k, h and p of (A.1c) to (A.1e): tau times the variations of the constraints.
inline void put_constraint_sides(const SemiImplicitContext& context,
                                 const fem::TangentFrame<double>& frame,
                                 const model::SurfacePoint<double>& surface,
                                 std::array<Integrand, side::count>& out) {
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t index) {
    const auto v = model::variation_of_term<Constraint>(context.point.physics.material, surface);
    const double tau = context.time_step;
    out[side::constraints + index] = integrand(frame, tau * v.a, tau * v.b);
    out[side::phase_constraints + index] = integrand(frame, tau * v.s, tau * v.q);
  });
}

/// Pair and node integrals of one element, added up over the quadrature points.
inline void add_semi_implicit_element(const SemiImplicitContext& context,
                                      const mesh::QuadraticTriangle& triangle, PairIntegrals& pairs,
                                      NodeIntegrals& nodes) {
  auto element = element_values(context.fields, triangle);
  for (std::size_t i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k)
      element.shape_operator[i][static_cast<std::size_t>(k)] =
          context.shape_operator(triangle[i], k);
  }
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = problem::point_inputs(element, shape);
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const auto surface =
        problem::surface_point(in, frame, problem::interpolated_shape_operator(element, shape));
    const auto weights = pair_weights(context, in, frame);
    add_pair_integrals(weights, frame, point, pairs);
    std::array<Integrand, side::count> sides{};
    put_explicit_sides(context, in, frame, surface, weights, sides);
    put_tangential_sides(context, surface.position, frame, sides);
    put_constraint_sides(context, frame, surface, sides);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < side::count; ++k) {
        nodes[i][k] += point.weight * (shape.value[i] * sides[k][0] + shape.du[i] * sides[k][1] +
                                       shape.dv[i] * sides[k][2]);
      }
    }
  }
}

}  // namespace vesica::paper
