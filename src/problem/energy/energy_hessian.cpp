#include <vector>

#include "energy_element.hpp"
#include "problem/dual_inputs.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/problem/energy_problem.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// The inputs that are differentiated, in this order: x, x_u, x_v, p, p_u, p_v, (c, u, v), x'.
using EnergyDual = Dual<24>;
/// s, x_u, x_v, x_uu, x_uv, x_vv.
using CurvatureDual = Dual<16>;

/// What the assembly of one element needs besides its fields. Unknowns of a node: p (0, 1, 2),
/// displacement along its direction (3), c (4).
struct ElementContext {
  const model::Physics& physics;
  const Multipliers& multipliers;
  const JacobianWeights& weights;
  std::array<Vec3<double>, 6> directions;
};

/// One output of the point gradient, differentiated with respect to the nodal unknowns.
template <int Block>
using OutputRow = std::array<double, 6 * Block>;

template <int Block>
OutputRow<Block> energy_row(const ElementContext& context, const fem::ShapeValues& shape,
                            const EnergyDual& output) {
  const auto& d = output.derivatives;
  const auto& w = context.weights;
  OutputRow<Block> row{};
  for (std::size_t j = 0; j < 6; ++j) {
    const double value = shape.value[j];
    const double du = shape.du[j];
    const double dv = shape.dv[j];
    double* columns = &row[j * Block];
    for (std::size_t k = 0; k < 3; ++k)
      columns[k] = value * d[9 + k] + du * d[12 + k] + dv * d[15 + k];
    const auto along = [&](std::size_t k) {
      return w.value * (value * d[k] + du * d[3 + k] + dv * d[6 + k]) + w.rate * value * d[21 + k];
    };
    const auto& n = context.directions[j];
    columns[3] = n.x * along(0) + n.y * along(1) + n.z * along(2);
    if constexpr (Block == 5) columns[4] = w.value * (value * d[18] + du * d[19] + dv * d[20]);
  }
  return row;
}

template <int Block>
void add_scaled(double factor, const OutputRow<Block>& row, std::array<double, 6 * Block>& sum) {
  for (std::size_t k = 0; k < row.size(); ++k) sum[k] += factor * row[k];
}

template <int Block>
using VectorRows = std::array<OutputRow<Block>, 3>;

template <int Block>
VectorRows<Block> energy_rows(const ElementContext& context, const fem::ShapeValues& shape,
                              const Vec3<EnergyDual>& output) {
  return {energy_row<Block>(context, shape, output.x), energy_row<Block>(context, shape, output.y),
          energy_row<Block>(context, shape, output.z)};
}

/// The fields of a point as inputs that are differentiated.
EnergyPoint<EnergyDual> as_inputs(const EnergyPoint<double>& values,
                                  DualInputs<EnergyDual>& inputs) {
  EnergyPoint<EnergyDual> in;
  in.x = inputs.vector(values.x);
  in.x_u = inputs.vector(values.x_u);
  in.x_v = inputs.vector(values.x_v);
  in.p = inputs.vector(values.p);
  in.p_u = inputs.vector(values.p_u);
  in.p_v = inputs.vector(values.p_v);
  in.c = inputs.scalar(values.c);
  in.c_u = inputs.scalar(values.c_u);
  in.c_v = inputs.scalar(values.c_v);
  return in;
}

template <int Block>
void add_energy_point(const ElementContext& context, const EnergyElement& element,
                      const fem::QuadraturePoint& point, fem::ElementMatrix<Block>& matrix) {
  const auto& shape = point.shape;
  const auto values = energy_point(element, shape);
  DualInputs<EnergyDual> inputs;
  const auto in = as_inputs(values, inputs);
  const auto velocity = inputs.vector(interpolate_nodes(element.velocity, shape.value));
  auto out = energy_point_gradient(context.physics, context.multipliers, in);
  add_flow_terms(context.physics, velocity, interpolate_nodes(element.c_rate, shape.value), in,
                 out);

  const std::array<VectorRows<Block>, 3> x{energy_rows<Block>(context, shape, out.x),
                                           energy_rows<Block>(context, shape, out.x_u),
                                           energy_rows<Block>(context, shape, out.x_v)};
  const std::array<VectorRows<Block>, 3> p{energy_rows<Block>(context, shape, out.p),
                                           energy_rows<Block>(context, shape, out.p_u),
                                           energy_rows<Block>(context, shape, out.p_v)};
  const std::array<OutputRow<Block>, 3> c{energy_row<Block>(context, shape, out.c),
                                          energy_row<Block>(context, shape, out.c_u),
                                          energy_row<Block>(context, shape, out.c_v)};
  const auto& m = context.physics.material;
  const double mobility = m.interface_width * m.kinetic_coefficient *
                          norm(cross(values.x_u, values.x_v)) * context.weights.rate;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::array<double, 3> test{point.weight * shape.value[i], point.weight * shape.du[i],
                                     point.weight * shape.dv[i]};
    const auto& n = context.directions[i];
    const std::array<double, 3> direction{n.x, n.y, n.z};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      for (std::size_t k = 0; k < 3; ++k) {
        add_scaled<Block>(test[kind], p[kind][k], matrix[i * Block + k]);
        add_scaled<Block>(test[kind] * direction[k], x[kind][k], matrix[i * Block + 3]);
      }
      if constexpr (Block == 5) add_scaled<Block>(test[kind], c[kind], matrix[i * Block + 4]);
    }
    if constexpr (Block == 5) {
      for (std::size_t j = 0; j < 6; ++j)
        matrix[i * Block + 4][j * Block + 4] += test[0] * mobility * shape.value[j];
    }
  }
}

/// One output of a distributional curvature, differentiated with respect to displacements and c.
template <int Block>
OutputRow<Block> curvature_row(const ElementContext& context, const fem::ShapeValues& shape,
                               const std::array<double, 6>& weight_derivatives,
                               const CurvatureDual& output) {
  constexpr auto second = fem::shape_second_derivatives();
  const auto& d = output.derivatives;
  OutputRow<Block> row{};
  for (std::size_t j = 0; j < 6; ++j) {
    const auto along = [&](std::size_t k) {
      return shape.du[j] * d[1 + k] + shape.dv[j] * d[4 + k] + second.duu[j] * d[7 + k] +
             second.duv[j] * d[10 + k] + second.dvv[j] * d[13 + k];
    };
    const auto& n = context.directions[j];
    row[Block * j + 3] = context.weights.value * (n.x * along(0) + n.y * along(1) + n.z * along(2));
    if constexpr (Block == 5)
      row[5 * j + 4] = context.weights.value * shape.value[j] * d[0] * weight_derivatives[j];
  }
  return row;
}

template <int Block>
void add_curvature_point(const ElementContext& context, const fem::ShapeValues& shape,
                         double weight, const std::array<double, 6>& weight_derivatives,
                         const CurvaturePoint<CurvatureDual>& g,
                         fem::ElementMatrix<Block>& matrix) {
  constexpr auto second = fem::shape_second_derivatives();
  const auto row_of = [&](const CurvatureDual& output) {
    return curvature_row<Block>(context, shape, weight_derivatives, output);
  };
  const std::array<const Vec3<CurvatureDual>*, 5> outputs{&g.x_u, &g.x_v, &g.x_uu, &g.x_uv,
                                                          &g.x_vv};
  std::array<VectorRows<Block>, 5> rows;
  for (std::size_t kind = 0; kind < 5; ++kind)
    rows[kind] = {row_of(outputs[kind]->x), row_of(outputs[kind]->y), row_of(outputs[kind]->z)};
  const auto by_weight = row_of(g.s);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::array<double, 5> test{shape.du[i], shape.dv[i], second.duu[i], second.duv[i],
                                     second.dvv[i]};
    const auto& n = context.directions[i];
    const std::array<double, 3> direction{n.x, n.y, n.z};
    for (std::size_t kind = 0; kind < 5; ++kind) {
      for (std::size_t k = 0; k < 3; ++k)
        add_scaled<Block>(weight * test[kind] * direction[k], rows[kind][k], matrix[Block * i + 3]);
    }
    if constexpr (Block == 5)
      add_scaled<5>(weight * shape.value[i] * weight_derivatives[i], by_weight, matrix[5 * i + 4]);
  }
}

CurvaturePoint<CurvatureDual> as_inputs(const CurvaturePoint<double>& values) {
  DualInputs<CurvatureDual> inputs;
  CurvaturePoint<CurvatureDual> in;
  in.s = inputs.scalar(values.s);
  in.x_u = inputs.vector(values.x_u);
  in.x_v = inputs.vector(values.x_v);
  in.x_uu = inputs.vector(values.x_uu);
  in.x_uv = inputs.vector(values.x_uv);
  in.x_vv = inputs.vector(values.x_vv);
  in.normal = values.normal;
  return in;
}

/// Adds `factor` times the second derivative of sum_i s(c_i) int phi_i dK (or dkappa) of an
/// element.
template <class Term, int Block>
void add_curvature_hessian(const ElementContext& context, double factor,
                           const EnergyElement& element, fem::ElementMatrix<Block>& matrix) {
  const auto& material = context.physics.material;
  const auto s = curvature_weights<Term, double>(material, element);
  std::array<double, 6> first{};
  std::array<double, 6> second{};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto d = Term::curvature_weight_derivative(material, Dual<1>::input(element.c[i], 0));
    first[i] = d.value;
    second[i] = d.derivatives[0];
  }
  std::array<double, 6> by_weight{};
  if constexpr (Term::curvature == model::Curvature::gauss) by_weight = element.vertex_angle;
  for_each_curvature_point<Term::curvature>(
      [&](const fem::ShapeValues& shape, double weight, const auto& integrand) {
        const auto in = as_inputs(curvature_point<double>(element, s, shape));
        const auto gradient = integrand(in).gradient;
        for (std::size_t i = 0; i < 6; ++i)
          by_weight[i] += weight * shape.value[i] * gradient.s.value;
        add_curvature_point<Block>(context, shape, factor * weight, first, gradient, matrix);
      });
  if constexpr (Block == 5) {
    for (std::size_t i = 0; i < 6; ++i)
      matrix[5 * i + 4][5 * i + 4] += factor * context.weights.value * second[i] * by_weight[i];
  }
}

}  // namespace

template <int Block>
void EnergyProblem::assemble_hessian(const EnergyFields& fields, const Multipliers& multipliers,
                                     const EnergyRates& rates, const mesh::Positions& directions,
                                     const JacobianWeights& weights,
                                     linalg::SparseMatrix& matrix) const {
  const auto physics = model_.at(fields.time);
  const Surroundings around{vertex_angles_,
                            shared_directions(physics, *triangulation_, fields.positions)};
  std::vector<double> blocks(at(triangulation_->num_triangles()) * 36 * Block * Block);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto& triangle = triangulation_->triangles()[at(t)];
      ElementContext context{physics, multipliers, weights, {}};
      const auto element = energy_element(fields, rates, triangle, around);
      for (std::size_t i = 0; i < 6; ++i) context.directions[i] = row_of(directions, triangle[i]);
      fem::ElementMatrix<Block> local{};
      for (const auto& point : fem::triangle_rule())
        add_energy_point<Block>(context, element, point, local);
      for_each_curvature_term(physics, multipliers, [&]<class Term>(double factor) {
        add_curvature_hessian<Term, Block>(context, factor, element, local);
      });
      fem::store_blocks<Block>(local, &blocks[at(t) * 36 * Block * Block]);
    }
  });
  fem::gather_blocks<Block>(graph_, blocks, threads_, matrix);
}

void EnergyProblem::hessian(const EnergyFields& fields, const Multipliers& multipliers,
                            const EnergyRates& rates, const mesh::Positions& directions,
                            const JacobianWeights& weights, linalg::SparseMatrix& matrix) const {
  if (model_.is_two_phase) {
    assemble_hessian<5>(fields, multipliers, rates, directions, weights, matrix);
  } else {
    assemble_hessian<4>(fields, multipliers, rates, directions, weights, matrix);
  }
}

}  // namespace vesica::problem
