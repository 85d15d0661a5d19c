#include "vesica/problem/energy_problem.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>
#include <vector>

#include "energy_gradient_kernel.hpp"
#include "vesica/core/dual.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Sums entries of shape (T, 6, count) over the elements of each node, shape (N, count).
Eigen::MatrixXd gather(const fem::NodeGraph& graph, std::span<const double> local,
                       Eigen::Index count, int threads) {
  Eigen::MatrixXd result(graph.num_nodes(), count);
  fem::gather_nodal(graph, local, threads, result);
  return result;
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

MomentEquations EnergyProblem::moment_equations(const EnergyFields& fields) const {
  const auto physics = model_.at(fields.time);
  const EnergyFields at_zero{fields.positions, {}, fields.order_parameter, fields.time};
  const auto count = at(triangulation_->num_triangles());
  std::vector<double> mass(count * 36);
  ElementNumbers rhs(triangulation_->num_triangles(), 18);
  for_each_pack(triangulation_->num_triangles(), threads_, [&](int first) {
    const auto element = element_pack<Pack>(*triangulation_, first, at_zero, {});
    MomentTable moment{};
    add_moment_equations(physics, element, moment);
    store(moment, first, rhs.span());
    MassTable density{};
    add_moment_mass(physics, element, density);
    store(density, first, mass);
  });
  return {fem::gather_mass_matrix(graph_, mass, threads_), gather(graph_, rhs.span(), 3, threads_)};
}

mesh::Positions EnergyProblem::moment(const mesh::Positions& positions,
                                      const Eigen::VectorXd& order_parameter, double time) const {
  const auto equations = moment_equations({positions, {}, order_parameter, time});
  return fem::solve_mass_matrix(equations.mass, equations.rhs, threads_);
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
      const auto element = energy_element(fields, {}, triangulation_->triangles()[at(t)]);
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

/// Sums the derivative of E_h + sum lambda_i C_i over the elements of each node, shape (N, 7): x,
/// p, c. With a change, T = PackDual, its change, without that of p.
template <class T, class Change>
Eigen::MatrixXd EnergyProblem::assemble_gradient(const EnergyFields& fields,
                                                 const Multipliers& multipliers,
                                                 const EnergyRates& rates,
                                                 const Change* along) const {
  const auto physics = model_.at(fields.time);
  bool is_curved = false;
  for_each_curvature_term(physics, multipliers, [&]<class>(double) { is_curved = true; });
  const Surroundings around{vertex_angles_,
                            shared_directions(physics, *triangulation_, fields.positions)};
  ElementNumbers local(triangulation_->num_triangles(), 42);
  for_each_pack(triangulation_->num_triangles(), threads_, [&](int first) {
    auto element = element_pack<T>(*triangulation_, first, fields, rates, along);
    GradientTable table{};
    add_energy_gradient(physics, multipliers, element, along == nullptr, table);
    if (is_curved) {
      surround(*triangulation_, first, around, element);
      add_curvature_terms(physics, multipliers, element, table);
    }
    store(table, first, local.span());
  });
  return gather(graph_, local.span(), 7, threads_);
}

EnergyFields EnergyProblem::gradient(const EnergyFields& fields, const Multipliers& multipliers,
                                     const EnergyRates& rates) const {
  const EnergyChange* none = nullptr;
  const auto sums = assemble_gradient<Pack>(fields, multipliers, rates, none);
  check_finite(sums.allFinite(), "the gradient");
  EnergyFields result{sums.leftCols<3>(), sums.middleCols<3>(3), {}};
  if (model_.is_two_phase) result.order_parameter = sums.col(6);
  return result;
}

mesh::Positions EnergyProblem::moment_change(const EnergyFields& fields,
                                             const EnergyFields& change) const {
  const auto physics = model_.at(fields.time);
  const EnergyChange along{change, {}};
  ElementNumbers local(triangulation_->num_triangles(), 18);
  for_each_pack(triangulation_->num_triangles(), threads_, [&](int first) {
    const auto element = element_pack<PackDual>(*triangulation_, first, fields, {}, &along);
    MomentTable table{};
    add_moment_equations(physics, element, table);
    store(table, first, local.span());
  });
  return gather(graph_, local.span(), 3, threads_);
}

EnergyFields EnergyProblem::gradient_change(const EnergyFields& fields,
                                            const Multipliers& multipliers,
                                            const EnergyRates& rates, const EnergyFields& change,
                                            const EnergyRates& rate_change) const {
  const EnergyChange along{change, rate_change};
  const auto sums = assemble_gradient<PackDual>(fields, multipliers, rates, &along);
  EnergyFields result{sums.leftCols<3>(), {}, {}};
  if (model_.is_two_phase) result.order_parameter = sums.col(6);
  return result;
}

template <class T>
ConstraintEvaluation EnergyProblem::assemble_constraints(const EnergyFields& fields,
                                                         const EnergyRates& rates) const {
  const auto count = at(triangulation_->num_triangles());
  constexpr std::size_t num = model::num_constraints;
  constexpr std::size_t row_size = 4 * num;  // of a node: for each constraint x (3) and c
  ElementNumbers local(triangulation_->num_triangles(), 6 * row_size);
  std::vector<double> values(count * num);
  const auto physics = model_.at(fields.time);
  const Surroundings around{vertex_angles_,
                            shared_directions(physics, *triangulation_, fields.positions)};
  const EnergyFields moved{rates.velocity, {}, rates.order_parameter};
  const EnergyChange along{moved, {}};
  for_each_pack(triangulation_->num_triangles(), threads_, [&](int first) {
    auto element = element_pack<T>(*triangulation_, first, fields, {},
                                   rates.velocity.rows() > 0 ? &along : nullptr);
    if (around.directions.rows() > 0) surround(*triangulation_, first, around, element);
    const auto sums = element_constraint_gradients<T>(element, physics);
    std::array<Pack, num> totals;
    std::array<Pack, 6 * row_size> table{};
    for (std::size_t k = 0; k < num; ++k) {
      totals[k] = summand(sums.values[k]);
      for (std::size_t i = 0; i < 6; ++i) {
        add(summand(sums.dx[k][i]), &table[i * row_size + 4 * k]);
        table[i * row_size + 4 * k + 3] += summand(sums.dc[k][i]);
      }
    }
    store(totals, first, values);
    store(table, first, local.span());
  });
  const Eigen::MatrixXd sums = gather(graph_, local.span(), row_size, threads_);
  ConstraintEvaluation result;
  for (std::size_t i = 0; i < values.size(); ++i) result.values[i % num] += values[i];
  for (std::size_t k = 0; k < num; ++k) {
    const auto column = static_cast<Eigen::Index>(4 * k);
    result.positions[k] = sums.middleCols<3>(column);
    if (model_.is_two_phase) result.order_parameter[k] = sums.col(column + 3);
  }
  return result;
}

ConstraintEvaluation EnergyProblem::constraints(const mesh::Positions& positions,
                                                const Eigen::VectorXd& order_parameter) const {
  return assemble_constraints<Pack>({positions, {}, order_parameter}, {});
}

ConstraintEvaluation EnergyProblem::constraint_rates(const mesh::Positions& positions,
                                                     const Eigen::VectorXd& order_parameter,
                                                     const EnergyRates& rates) const {
  return assemble_constraints<PackDual>({positions, {}, order_parameter}, rates);
}

}  // namespace vesica::problem
