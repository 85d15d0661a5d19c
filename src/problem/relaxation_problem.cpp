#include "vesica/problem/relaxation_problem.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "element_equations.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/fem/block_assembly.hpp"
#include "vesica/fem/recovery.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

mesh::Positions positions_of(const DofLayout& layout, const Eigen::VectorXd& y) {
  const auto block = layout.block_size();
  mesh::Positions positions(layout.num_nodes(), 3);
  for (Eigen::Index i = 0; i < layout.num_nodes(); ++i)
    positions.row(i) = y.segment<3>(i * block).transpose();
  return positions;
}

PointSettings point_settings(const model::Physics& physics, const DofLayout& layout, double damping,
                             const Eigen::VectorXd& y) {
  PointSettings settings{physics, damping, {}};
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout.multiplier(i) >= 0)
      settings.multipliers[at(i)] = y[layout.num_nodal() + layout.multiplier(i)];
  }
  return settings;
}

void check_finite(const Eigen::VectorXd& values, const DofLayout& layout,
                  const mesh::Positions& positions, std::string_view what) {
  if (values.allFinite()) return;
  Eigen::Index row = 0;
  while (std::isfinite(values[row])) ++row;
  if (row >= layout.num_nodal())
    throw RecoverableError(fmt::format("{} of a constraint is not finite", what));
  const auto node = row / layout.block_size();
  throw RecoverableError(fmt::format("{} is not finite at node {}, x = ({:.4g}, {:.4g}, {:.4g})",
                                     what, node, positions(node, 0), positions(node, 1),
                                     positions(node, 2)));
}

/// Calls visit(Block) with the number of unknowns a node as a compile-time constant.
template <class Visit>
auto with_block_size(const DofLayout& layout, Visit&& visit) {
  if (layout.is_two_phase()) return visit(std::integral_constant<int, 5>{});
  return visit(std::integral_constant<int, 4>{});
}

/// What `shared_directions` returns, with positions taken out of y only where they are needed.
mesh::Positions directions_at(const model::Physics& physics,
                              const mesh::Triangulation& triangulation, const DofLayout& layout,
                              const Eigen::VectorXd& y) {
  if (!needs_directions(physics)) return {};
  return nodal_normals(triangulation, positions_of(layout, y));
}

/// Element nodes as dual numbers: derivative = the change of the surface along the rates.
ElementNodes<Dual<1>> nodes_with_rates(const DofLayout& layout,
                                       const mesh::QuadraticTriangle& triangle,
                                       const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                                       const mesh::Positions& directions) {
  ElementNodes<Dual<1>> nodes;
  put_directions(directions, triangle, nodes);
  const auto block = layout.block_size();
  const auto dual = [&](Eigen::Index row) {
    Dual<1> result(y[row]);
    result.derivatives[0] = y_rate[row];
    return result;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const Eigen::Index first = static_cast<Eigen::Index>(triangle[i]) * block;
    nodes.x[i] = {dual(first), dual(first + 1), dual(first + 2)};
    nodes.c[i] = layout.is_two_phase() ? dual(first + 4) : Dual<1>(1.0);
  }
  return nodes;
}

}  // namespace

RelaxationProblem::RelaxationProblem(std::shared_ptr<const mesh::Triangulation> triangulation,
                                     model::Model model, int threads)
    : triangulation_(std::move(triangulation)),
      model_(std::move(model)),
      graph_(*triangulation_),
      layout_(triangulation_->num_nodes(), model_),
      threads_(resolved_threads(threads)) {}

/// kappa of the start is that of its recovered shape operator, -tr Q.
Eigen::VectorXd RelaxationProblem::initial_values(const State& start) const {
  Fields values = start.values;
  const auto q =
      fem::recover_shape_operator(*triangulation_, graph_, start.values.positions, threads_);
  values.mean_curvature = -(q.col(0) + q.col(1) + q.col(2));
  return layout_.pack(values);
}

Unknowns RelaxationProblem::unknowns(const State& state) const {
  return {layout_.pack(state.values), layout_.pack(state.rates)};
}

/// Diameter 2 R_c and range 2 of c, and as much in units of curvature.
Eigen::VectorXd RelaxationProblem::units(const Scales& scales) const {
  Eigen::VectorXd units(layout_.size());
  for (Eigen::Index row = 0; row < layout_.num_nodal(); ++row) {
    const auto component = row % layout_.block_size();
    units[row] = component < 3 ? scales.length : component == 3 ? 1 / scales.length : 1;
  }
  units.tail(layout_.num_multipliers()).setConstant(scales.multiplier());
  return units;
}

Eigen::VectorXd RelaxationProblem::residual(const EquationSettings& settings, double time,
                                            const Eigen::VectorXd& y,
                                            const Eigen::VectorXd& y_rate) const {
  const auto positions = positions_of(layout_, y);
  const auto shape_operator =
      fem::recover_shape_operator(*triangulation_, graph_, positions, threads_);
  const auto physics = model_.at(time);
  const EquationContext context{point_settings(physics, layout_, settings.damping, y),
                                shape_operator, y, y_rate, layout_.block_size()};
  const auto block = at(layout_.block_size());
  std::vector<double> local(at(triangulation_->num_triangles()) * 6 * block, 0.0);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    with_block_size(layout_, [&](auto size) {
      for (int t = begin; t < end; ++t) {
        const auto element = element_values(context, triangulation_->triangles()[at(t)]);
        add_element_residual<size>(context, element, &local[at(t) * 6 * block]);
      }
    });
  });
  Eigen::VectorXd result(layout_.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  fem::gather_nodal(graph_, local, threads_,
                    Eigen::Map<Rows>(result.data(), layout_.num_nodes(), layout_.block_size()));
  const auto measured = constraints(y, y_rate);
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout_.multiplier(i) < 0) continue;
    const auto& target = *model_.targets[at(i)];
    const double error = measured.value[at(i)] - target.value(time);
    result[layout_.num_nodal() + layout_.multiplier(i)] =
        settings.form == ConstraintForm::original
            ? error
            : measured.rate[at(i)] - target.rate(time) + settings.constraint_rate * error;
  }
  check_finite(result, layout_, positions, "the residual");
  return result;
}

linalg::BorderedMatrix RelaxationProblem::make_matrix() const {
  linalg::BorderedMatrix matrix;
  matrix.block = graph_.block_pattern(layout_.block_size());
  matrix.columns = Eigen::MatrixXd::Zero(layout_.num_nodal(), layout_.num_multipliers());
  matrix.rows = Eigen::MatrixXd::Zero(layout_.num_multipliers(), layout_.num_nodal());
  return matrix;
}

void RelaxationProblem::jacobian(const EquationSettings& settings, const JacobianWeights& weights,
                                 double time, const Eigen::VectorXd& y,
                                 const Eigen::VectorXd& y_rate,
                                 linalg::BorderedMatrix& matrix) const {
  const auto shape_operator =
      fem::recover_shape_operator(*triangulation_, graph_, positions_of(layout_, y), threads_);
  const auto physics = model_.at(time);
  const EquationContext context{point_settings(physics, layout_, settings.damping, y),
                                shape_operator, y, y_rate, layout_.block_size()};
  with_block_size(layout_,
                  [&](auto size) { assemble_block<size>(context, weights, matrix.block); });
  with_block_size(layout_, [&](auto size) { assemble_columns<size>(context, matrix.columns); });
  assemble_rows(settings, weights, y, y_rate, matrix.rows);
}

template <int Block>
void RelaxationProblem::assemble_block(const EquationContext& context,
                                       const JacobianWeights& weights,
                                       linalg::SparseMatrix& matrix) const {
  std::vector<double> blocks(at(triangulation_->num_triangles()) * 36 * Block * Block);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      fem::ElementMatrix<Block> local{};
      add_element_jacobian<Block>(
          context, weights, element_values(context, triangulation_->triangles()[at(t)]), local);
      fem::store_blocks<Block>(local, &blocks[at(t) * 36 * Block * Block]);
    }
  });
  fem::gather_blocks<Block>(graph_, blocks, threads_, matrix);
}

template <int Block>
void RelaxationProblem::assemble_columns(const EquationContext& context,
                                         Eigen::MatrixXd& columns) const {
  constexpr std::size_t element_size = 6 * Block * model::num_constraints;
  std::vector<double> local(at(triangulation_->num_triangles()) * element_size, 0.0);
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      add_multiplier_columns<Block>(context.point.physics,
                                    element_values(context, triangulation_->triangles()[at(t)]),
                                    &local[at(t) * element_size]);
    }
  });
  columns.setZero();
  for (int node = 0; node < graph_.num_nodes(); ++node) {
    for (const auto code : graph_.incidences(node)) {
      for (std::size_t r = 0; r < Block; ++r) {
        for (int i = 0; i < model::num_constraints; ++i) {
          if (layout_.multiplier(i) < 0) continue;
          columns(static_cast<Eigen::Index>(at(node) * Block + r), layout_.multiplier(i)) +=
              local[(at(code) * Block + r) * model::num_constraints + at(i)];
        }
      }
    }
  }
}

void RelaxationProblem::assemble_rows(const EquationSettings& settings,
                                      const JacobianWeights& weights, const Eigen::VectorXd& y,
                                      const Eigen::VectorXd& y_rate, Eigen::MatrixXd& rows) const {
  const bool is_original = settings.form == ConstraintForm::original;
  // row = gradient_weight * dC/dy + second_weight * (d^2C/dy^2 y')
  const double gradient_weight =
      is_original ? weights.value : weights.value * settings.constraint_rate + weights.rate;
  const double second_weight = is_original ? 0 : weights.value;
  const auto entry = [&](const Dual<1>& g) {
    return gradient_weight * g.value + second_weight * g.derivatives[0];
  };
  const auto physics = model_.at(0);  // the constraints do not depend on the material
  const auto directions = directions_at(physics, *triangulation_, layout_, y);
  rows.setZero();
  for (const auto& triangle : triangulation_->triangles()) {
    const auto element = element_constraint_gradients(
        nodes_with_rates(layout_, triangle, y, y_rate, directions), physics);
    for (int k = 0; k < model::num_constraints; ++k) {
      const int row = layout_.multiplier(k);
      if (row < 0) continue;
      for (std::size_t i = 0; i < 6; ++i) {
        const Eigen::Index first = static_cast<Eigen::Index>(triangle[i]) * layout_.block_size();
        const auto& gradient = element.dx[at(k)][i];
        rows(row, first) += entry(gradient.x);
        rows(row, first + 1) += entry(gradient.y);
        rows(row, first + 2) += entry(gradient.z);
        if (layout_.is_two_phase()) rows(row, first + 4) += entry(element.dc[at(k)][i]);
      }
    }
  }
}

ConstraintValues RelaxationProblem::constraints(const Eigen::VectorXd& y,
                                                const Eigen::VectorXd& y_rate) const {
  const auto physics = model_.at(0);
  const auto directions = directions_at(physics, *triangulation_, layout_, y);
  std::vector<std::array<Dual<1>, model::num_constraints>> elements(
      at(triangulation_->num_triangles()));
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      elements[at(t)] = element_constraint_values(
          nodes_with_rates(layout_, triangulation_->triangles()[at(t)], y, y_rate, directions),
          physics);
    }
  });
  ConstraintValues sum;
  for (const auto& element : elements) {
    for (std::size_t k = 0; k < model::num_constraints; ++k) {
      sum.value[k] += element[k].value;
      sum.rate[k] += element[k].derivatives[0];
    }
  }
  return sum;
}

}  // namespace vesica::problem
