#include "vesica/problem/energy_problem.hpp"

#include <fmt/format.h>

#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "energy_element.hpp"
#include "vesica/core/dual.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/fem/mass_matrix.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Sums entries of shape (T, 6, count) over the elements of each node, shape (N, count).
Eigen::MatrixXd gather(const fem::NodeGraph& graph, const std::vector<double>& local,
                       Eigen::Index count, int threads) {
  Eigen::MatrixXd result(graph.num_nodes(), count);
  fem::gather_nodal(graph, local, threads, result);
  return result;
}

void add(const Vec3<double>& a, double* out) {
  out[0] += a.x;
  out[1] += a.y;
  out[2] += a.z;
}

/// sum over the three derivatives of an integrand times those of the shape function of node i.
template <class V>
V test_with(const fem::ShapeValues& shape, std::size_t i, const V& value, const V& du,
            const V& dv) {
  return shape.value[i] * value + shape.du[i] * du + shape.dv[i] * dv;
}

/// Adds the derivative at the nodes of one element to `local`, shape (6, 7): x, p, c.
void add_element_gradient(const model::Physics& physics, const Multipliers& multipliers,
                          const EnergyElement& element, double* local) {
  for (const auto& point : fem::triangle_rule()) {
    const auto& shape = point.shape;
    const auto in = energy_point(element, shape);
    auto out = energy_point_gradient(physics, multipliers, in);
    add_flow_terms(physics, interpolate_nodes(element.velocity, shape.value),
                   interpolate_nodes(element.c_rate, shape.value), in, out);
    for (std::size_t i = 0; i < 6; ++i) {
      double* row = local + 7 * i;
      add(point.weight * test_with(shape, i, out.x, out.x_u, out.x_v), row);
      add(point.weight * test_with(shape, i, out.p, out.p_u, out.p_v), row + 3);
      row[6] += point.weight * test_with(shape, i, out.c, out.c_u, out.c_v);
    }
  }
}

void add_curvature_terms(const model::Physics& physics, const Multipliers& multipliers,
                         const EnergyElement& element, double* local) {
  for_each_curvature_term(physics, multipliers, [&]<class Term>(double factor) {
    std::array<Vec3<double>, 6> dx{};
    std::array<double, 6> dc{};
    add_curvature_gradient<Term, double>(physics.material, factor, element, dx, dc);
    for (std::size_t i = 0; i < 6; ++i) {
      add(dx[i], local + 7 * i);
      local[7 * i + 6] += dc[i];
    }
  });
}

/// A number whose derivative is a rate, or without it.
template <class T>
T with_rate(double value, double rate) {
  T result(value);
  if constexpr (!std::is_same_v<T, double>) result.derivatives[0] = rate;
  return result;
}

template <class T>
ElementNodes<T> constraint_nodes(const EnergyElement& element) {
  ElementNodes<T> nodes;
  nodes.normal = element.normal;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& x = element.x[i];
    const auto& v = element.velocity[i];
    nodes.x[i] = {with_rate<T>(x.x, v.x), with_rate<T>(x.y, v.y), with_rate<T>(x.z, v.z)};
    nodes.c[i] = with_rate<T>(element.c[i], element.c_rate[i]);
  }
  return nodes;
}

void check_finite(bool is_finite, std::string_view what) {
  if (!is_finite)
    throw RecoverableError(fmt::format("{} of the discrete energy is not finite", what));
}

}  // namespace

EnergyProblem::EnergyProblem(std::shared_ptr<const mesh::Triangulation> triangulation,
                             model::Model model, int threads)
    : triangulation_(std::move(triangulation)),
      model_(std::move(model)),
      graph_(*triangulation_),
      vertex_angles_(vertex_angles(*triangulation_)),
      threads_(resolved_threads(threads)) {}

mesh::Positions EnergyProblem::moment(const mesh::Positions& positions,
                                      const Eigen::VectorXd& order_parameter, double time) const {
  const EnergyFields fields{positions, {}, order_parameter};
  const auto physics = model_.at(time);
  const auto count = at(triangulation_->num_triangles());
  std::vector<double> mass(count * 36, 0.0);
  std::vector<double> rhs(count * 6 * 3, 0.0);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto element =
          energy_element(fields, {}, triangulation_->triangles()[at(t)], {vertex_angles_});
      for (const auto& point : fem::triangle_rule()) {
        const auto& shape = point.shape;
        const auto in = energy_point(element, shape);
        const auto frame = fem::tangent_frame(in.x_u, in.x_v);
        EnergyPoint<double> out;
        put_moment_derivative(physics, in, frame, out);  // at p = 0
        const double density = point.weight * frame.area_element /
                               model::interpolate(physics.material.bending_rigidity, in.c);
        for (std::size_t i = 0; i < 6; ++i) {
          add(point.weight * test_with(shape, i, out.p, out.p_u, out.p_v),
              &rhs[(at(t) * 6 + i) * 3]);
          for (std::size_t j = 0; j < 6; ++j)
            mass[at(t) * 36 + 6 * i + j] += density * shape.value[i] * shape.value[j];
        }
      }
    }
  });
  return fem::solve_mass_matrix(fem::gather_mass_matrix(graph_, mass, threads_),
                                gather(graph_, rhs, 3, threads_), threads_);
}

EnergyFields EnergyProblem::fields(const mesh::Positions& positions,
                                   const Eigen::VectorXd& order_parameter, double time) const {
  return {positions, moment(positions, order_parameter, time), order_parameter, time};
}

model::EnergyParts EnergyProblem::energy(const EnergyFields& fields) const {
  const auto physics = model_.at(fields.time);
  const auto count = at(triangulation_->num_triangles());
  std::vector<std::array<double, model::num_energies>> parts(count);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto element =
          energy_element(fields, {}, triangulation_->triangles()[at(t)], {vertex_angles_});
      for (const auto& point : fem::triangle_rule())
        add_densities(physics, energy_point(element, point.shape), point.weight, parts[at(t)]);
    }
  });
  model::EnergyParts sum;
  model::for_each_term<model::Energies>([&]<class Energy>(std::size_t place) {
    if constexpr (model::CurvatureTerm<Energy>) {
      sum[place] = curvature_energy<Energy>(physics, *triangulation_, vertex_angles_,
                                            fields.positions, fields.order_parameter, threads_);
    } else if (model::takes_part<Energy>(physics)) {
      double total = 0;
      for (const auto& part : parts) total += part[place];
      sum[place] = total;
    }
  });
  check_finite(std::isfinite(sum.total()), "the value");
  return sum;
}

Eigen::VectorXd EnergyProblem::mean_curvature(const EnergyFields& fields) const {
  const auto normals = nodal_normals(*triangulation_, fields.positions);
  const auto material = model_.material.at(fields.time);
  Eigen::VectorXd curvature(normals.rows());
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const double c = model_.is_two_phase ? fields.order_parameter[i] : 1.0;
    curvature[i] =
        model::interpolate(material.spontaneous_curvature, c) -
        fields.moment.row(i).dot(normals.row(i)) / model::interpolate(material.bending_rigidity, c);
  }
  return curvature;
}

EnergyFields EnergyProblem::gradient(const EnergyFields& fields, const Multipliers& multipliers,
                                     const EnergyRates& rates) const {
  const auto physics = model_.at(fields.time);
  const Surroundings around{vertex_angles_,
                            shared_directions(physics, *triangulation_, fields.positions)};
  std::vector<double> local(at(triangulation_->num_triangles()) * 42, 0.0);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto element =
          energy_element(fields, rates, triangulation_->triangles()[at(t)], around);
      add_element_gradient(physics, multipliers, element, &local[at(t) * 42]);
      add_curvature_terms(physics, multipliers, element, &local[at(t) * 42]);
    }
  });
  const Eigen::MatrixXd sums = gather(graph_, local, 7, threads_);
  check_finite(sums.allFinite(), "the gradient");
  EnergyFields result{sums.leftCols<3>(), sums.middleCols<3>(3), {}};
  if (model_.is_two_phase) result.order_parameter = sums.col(6);
  return result;
}

template <class T, class Take>
ConstraintEvaluation EnergyProblem::assemble_constraints(const EnergyFields& fields,
                                                         const EnergyRates& rates,
                                                         const Take& take) const {
  const auto count = at(triangulation_->num_triangles());
  constexpr std::size_t num = model::num_constraints;
  constexpr std::size_t row_size = 4 * num;  // of a node: for each constraint x (3) and c
  std::vector<double> local(count * 6 * row_size, 0.0);
  std::vector<std::array<double, num>> values(count);
  const auto physics = model_.at(fields.time);
  const Surroundings around{vertex_angles_,
                            shared_directions(physics, *triangulation_, fields.positions)};
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto element =
          energy_element(fields, rates, triangulation_->triangles()[at(t)], around);
      const auto nodes = constraint_nodes<T>(element);
      const auto sums = element_constraint_values(nodes, physics);
      const auto gradients = element_constraint_gradients(nodes, physics);
      for (std::size_t k = 0; k < num; ++k) {
        values[at(t)][k] = take(sums[k]);
        for (std::size_t i = 0; i < 6; ++i) {
          double* row = &local[(at(t) * 6 + i) * row_size + 4 * k];
          const auto& g = gradients.dx[k][i];
          add({take(g.x), take(g.y), take(g.z)}, row);
          row[3] = take(gradients.dc[k][i]);
        }
      }
    }
  });
  const Eigen::MatrixXd sums = gather(graph_, local, row_size, threads_);
  ConstraintEvaluation result;
  for (const auto& value : values) {
    for (std::size_t k = 0; k < num; ++k) result.values[k] += value[k];
  }
  for (std::size_t k = 0; k < num; ++k) {
    const auto column = static_cast<Eigen::Index>(4 * k);
    result.positions[k] = sums.middleCols<3>(column);
    if (model_.is_two_phase) result.order_parameter[k] = sums.col(column + 3);
  }
  return result;
}

ConstraintEvaluation EnergyProblem::constraints(const mesh::Positions& positions,
                                                const Eigen::VectorXd& order_parameter) const {
  return assemble_constraints<double>({positions, {}, order_parameter}, {},
                                      [](double a) { return a; });
}

ConstraintEvaluation EnergyProblem::constraint_rates(const mesh::Positions& positions,
                                                     const Eigen::VectorXd& order_parameter,
                                                     const EnergyRates& rates) const {
  return assemble_constraints<Dual<1>>({positions, {}, order_parameter}, rates,
                                       [](const Dual<1>& a) { return a.derivatives[0]; });
}

}  // namespace vesica::problem
