#pragma once

#include <array>
#include <vector>

#include "dual_inputs.hpp"
#include "energy/constraint_kernel.hpp"
#include "point_equations.hpp"
#include "vesica/core/dual.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::problem {

/// Nodal values of one element, taken out of the flat vectors, a row a node: x, y, z, kappa, c.
struct ElementValues {
  using Rows = std::array<std::array<double, 5>, 6>;
  Rows value{};
  Rows rate{};
  std::array<std::array<double, 6>, 6> shape_operator{};
};

/// All arguments that the element loops read.
struct EquationContext {
  PointSettings point;
  const fem::NodalShapeOperator& shape_operator;
  const Eigen::VectorXd& y;
  const Eigen::VectorXd& y_rate;
  int block_size;
};

inline ElementValues element_values(const EquationContext& context,
                                    const mesh::QuadraticTriangle& triangle) {
  ElementValues element;
  const auto block = static_cast<std::size_t>(context.block_size);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto node = triangle[i];
    for (std::size_t k = 0; k < block; ++k) {
      const auto row = static_cast<Eigen::Index>(static_cast<std::size_t>(node) * block + k);
      element.value[i][k] = context.y[row];
      element.rate[i][k] = context.y_rate[row];
    }
    if (block == 4) element.value[i][4] = 1;  // one phase: phase 1 everywhere
    for (int k = 0; k < 6; ++k)
      element.shape_operator[i][static_cast<std::size_t>(k)] = context.shape_operator(node, k);
  }
  return element;
}

template <std::size_t Columns>
std::array<double, Columns> combine_rows(const std::array<std::array<double, Columns>, 6>& rows,
                                         const std::array<double, 6>& weights) {
  std::array<double, Columns> sum{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < Columns; ++k) sum[k] += weights[i] * rows[i][k];
  }
  return sum;
}

inline Vec3<double> head(const std::array<double, 5>& a) { return {a[0], a[1], a[2]}; }

inline Sym3<double> interpolated_shape_operator(const ElementValues& element,
                                                const fem::ShapeValues& shape) {
  const auto q = combine_rows(element.shape_operator, shape.value);
  return {q[0], q[1], q[2], q[3], q[4], q[5]};
}

inline PointInputs<double> point_inputs(const ElementValues& element,
                                        const fem::ShapeValues& shape) {
  constexpr auto second = fem::shape_second_derivatives();
  const auto value = combine_rows(element.value, shape.value);
  const auto du = combine_rows(element.value, shape.du);
  const auto dv = combine_rows(element.value, shape.dv);
  const auto rate = combine_rows(element.rate, shape.value);
  PointInputs<double> in;
  in.x = head(value);
  in.x_u = head(du);
  in.x_v = head(dv);
  in.x_uu = head(combine_rows(element.value, second.duu));
  in.x_uv = head(combine_rows(element.value, second.duv));
  in.x_vv = head(combine_rows(element.value, second.dvv));
  in.kappa = value[3];
  in.kappa_u = du[3];
  in.kappa_v = dv[3];
  in.c = value[4];
  in.c_u = du[4];
  in.c_v = dv[4];
  in.velocity = head(rate);
  in.c_rate = rate[4];
  return in;
}

/// Adds the element residual of (b), (a), (d) to `local`, shape (6, Block).
template <int Block>
void add_element_residual(const EquationContext& context, const ElementValues& element,
                          double* local) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = point_inputs(element, shape);
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const auto out =
        point_equations(context.point, in, frame, interpolated_shape_operator(element, shape));
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t r = 0; r < Block; ++r) {
        local[i * Block + r] += point.weight * (shape.value[i] * out[r][0] +
                                                shape.du[i] * out[r][1] + shape.dv[i] * out[r][2]);
      }
    }
  }
}

/// The 24 inputs that are differentiated, in this order: x_u, x_v, x_uu, x_uv, x_vv, (kappa, u, v),
/// (c, u, v), x'.
using PointDual = Dual<24>;

inline PointInputs<PointDual> dual_inputs(const PointInputs<double>& in) {
  DualInputs<PointDual> inputs;
  PointInputs<PointDual> out;
  out.x = {in.x.x, in.x.y, in.x.z};
  out.x_u = inputs.vector(in.x_u);
  out.x_v = inputs.vector(in.x_v);
  out.x_uu = inputs.vector(in.x_uu);
  out.x_uv = inputs.vector(in.x_uv);
  out.x_vv = inputs.vector(in.x_vv);
  out.kappa = inputs.scalar(in.kappa);
  out.kappa_u = inputs.scalar(in.kappa_u);
  out.kappa_v = inputs.scalar(in.kappa_v);
  out.c = inputs.scalar(in.c);
  out.c_u = inputs.scalar(in.c_u);
  out.c_v = inputs.scalar(in.c_v);
  out.velocity = inputs.vector(in.velocity);
  out.c_rate = in.c_rate;
  return out;
}

/// Returns the shape operator with the value of Q_h and the derivative of the elementwise one.
inline Sym3<PointDual> surrogate_shape_operator(const PointInputs<PointDual>& in,
                                                const fem::TangentFrame<PointDual>& frame,
                                                const Sym3<double>& recovered) {
  auto q = fem::element_shape_operator(frame, in.x_uu, in.x_uv, in.x_vv);
  q.xx.value = recovered.xx;
  q.yy.value = recovered.yy;
  q.zz.value = recovered.zz;
  q.xy.value = recovered.xy;
  q.yz.value = recovered.yz;
  q.xz.value = recovered.xz;
  return q;
}

/// d(outputs)/d(nodal unknowns) at a point: row 3 r + k belongs to outputs[r][k], column j Block +
/// l to unknown l of node j.
template <int Block>
using PointJacobian = std::array<std::array<double, 6 * Block>, 3 * Block>;

template <int Block>
PointJacobian<Block> point_jacobian(const PointOutputs<PointDual>& out,
                                    const fem::ShapeValues& shape, const JacobianWeights& weights,
                                    double phase_rate_coefficient) {
  constexpr auto second = fem::shape_second_derivatives();
  PointJacobian<Block> jacobian;
  for (std::size_t o = 0; o < 3 * Block; ++o) {
    const auto& d = out[o / 3][o % 3].derivatives;
    for (std::size_t j = 0; j < 6; ++j) {
      double* columns = &jacobian[o][j * Block];
      for (std::size_t k = 0; k < 3; ++k) {
        columns[k] = weights.value *
                         (shape.du[j] * d[k] + shape.dv[j] * d[3 + k] + second.duu[j] * d[6 + k] +
                          second.duv[j] * d[9 + k] + second.dvv[j] * d[12 + k]) +
                     weights.rate * shape.value[j] * d[21 + k];
      }
      columns[3] = shape.value[j] * d[15] + shape.du[j] * d[16] + shape.dv[j] * d[17];
      if constexpr (Block == 5) {
        columns[4] =
            weights.value * (shape.value[j] * d[18] + shape.du[j] * d[19] + shape.dv[j] * d[20]);
        if (o == 3 * phase_row)
          columns[4] += weights.rate * shape.value[j] * phase_rate_coefficient;
      }
    }
  }
  return jacobian;
}

template <int Block>
void add_element_jacobian(const EquationContext& context, const JacobianWeights& weights,
                          const ElementValues& element, fem::ElementMatrix<Block>& matrix) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = dual_inputs(point_inputs(element, shape));
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const auto q = surrogate_shape_operator(in, frame, interpolated_shape_operator(element, shape));
    const auto out = point_equations(context.point, in, frame, q);
    const double phase_rate = phase_mobility(context.point.physics) * frame.area_element.value;
    const auto jacobian = point_jacobian<Block>(out, shape, weights, phase_rate);
    for (std::size_t i = 0; i < 6; ++i) {
      const double value = point.weight * shape.value[i];
      const double du = point.weight * shape.du[i];
      const double dv = point.weight * shape.dv[i];
      for (std::size_t r = 0; r < Block; ++r) {
        auto& row = matrix[i * Block + r];
        for (std::size_t column = 0; column < 6 * Block; ++column) {
          row[column] += value * jacobian[3 * r][column] + du * jacobian[3 * r + 1][column] +
                         dv * jacobian[3 * r + 2][column];
        }
      }
    }
  }
}

/// Adds the derivative of the element residual with respect to the multipliers, the variations of
/// the constraints, to `local`, shape (6, Block, number of constraints).
template <int Block>
void add_multiplier_columns(const model::Physics& physics, const ElementValues& element,
                            double* local) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = point_inputs(element, shape);
    const auto frame = fem::tangent_frame(in.x_u, in.x_v);
    const auto surface = surface_point(in, frame, interpolated_shape_operator(element, shape));
    model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
      PointOutputs<double> out;
      put_variation(model::variation_of_term<Constraint>(physics.material, surface), frame, out);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t r = velocity_row; r < Block; ++r) {
          local[(i * Block + r) * model::num_constraints + place] +=
              point.weight *
              (shape.value[i] * out[r][0] + shape.du[i] * out[r][1] + shape.dv[i] * out[r][2]);
        }
      }
    });
  }
}

}  // namespace vesica::problem
