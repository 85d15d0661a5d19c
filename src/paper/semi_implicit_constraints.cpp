#include <cmath>
#include <vector>

#include "problem/energy/constraint_kernel.hpp"
#include "semi_implicit_kernel.hpp"
#include "vesica/core/parallel.hpp"
#include "vesica/paper/semi_implicit_problem.hpp"

/// What the quasi-Newton iteration of appendix B needs of SemiImplicitProblem.
namespace vesica::paper {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Changes of the normal position and of c with the multiplier in column `column`, at a point.
struct Displacement {
  double normal;
  double order_parameter;
};

Displacement displacement_at(const SemiImplicitSolution& solution, Eigen::Index column, int block,
                             const mesh::QuadraticTriangle& triangle, const fem::ShapeValues& shape,
                             const Vec3<double>& normal) {
  Displacement sum{0, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto u =
        solution.geometry.col(column).segment<3>(static_cast<Eigen::Index>(triangle[i]) * block);
    sum.normal -= shape.value[i] * (u[0] * normal.x + u[1] * normal.y + u[2] * normal.z);
    if (solution.phase.size() > 0)
      sum.order_parameter -= shape.value[i] * solution.phase(triangle[i], column);
  }
  return sum;
}

/// The nodes of an element; their derivatives are the changes with the multiplier in a column.
problem::ElementNodes<Dual<1>> nodes_with_changes(const problem::Fields& fields,
                                                  const SemiImplicitSolution& solution,
                                                  Eigen::Index column, int block,
                                                  const mesh::QuadraticTriangle& triangle) {
  problem::ElementNodes<Dual<1>> nodes;
  const auto dual = [](double value, double change) {
    Dual<1> result(value);
    result.derivatives[0] = change;
    return result;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const auto node = triangle[i];
    const auto u =
        solution.geometry.col(column).segment<3>(static_cast<Eigen::Index>(node) * block);
    const auto x = fields.positions.row(node);
    nodes.x[i] = {dual(x[0], -u[0]), dual(x[1], -u[1]), dual(x[2], -u[2])};
    nodes.c[i] = solution.phase.size() > 0
                     ? dual(fields.order_parameter[node], -solution.phase(node, column))
                     : Dual<1>(1.0);
  }
  return nodes;
}

using Slopes = Eigen::Matrix<double, model::num_constraints, model::num_constraints>;

/// Puts the slopes of the constraints that look at the curvature, the derivatives of what is
/// measured: the variation leaves out how the angles at the edges change.
void add_curved_slopes(const model::Physics& physics, const problem::Fields& fields,
                       const SemiImplicitSolution& solution, int block,
                       const mesh::QuadraticTriangle& triangle, const mesh::Positions& directions,
                       Slopes& slopes) {
  problem::for_each_curved_constraint(physics, [&]<class Constraint>(std::size_t row) {
    for (Eigen::Index column = 1; column < solution.geometry.cols(); ++column) {
      auto nodes = nodes_with_changes(fields, solution, column, block, triangle);
      problem::put_directions(directions, triangle, nodes);
      slopes(static_cast<Eigen::Index>(row), column - 1) =
          problem::curvature_integral<Constraint>(physics.material, nodes).derivatives[0];
    }
  });
}

}  // namespace

problem::Fields SemiImplicitProblem::fields_at(const SemiImplicitSolution& solution,
                                               const Eigen::VectorXd& multipliers) const {
  const auto n = layout_.num_nodes();
  const auto m = layout_.num_multipliers();
  const Eigen::VectorXd y = solution.geometry.col(0) - solution.geometry.rightCols(m) * multipliers;
  problem::Fields fields;
  fields.positions.resize(n, 3);
  fields.mean_curvature.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    fields.positions.row(i) = y.segment<3>(i * block_size()).transpose();
    fields.mean_curvature[i] = y[i * block_size() + 3];
  }
  if (layout_.is_two_phase())
    fields.order_parameter = solution.phase.col(0) - solution.phase.rightCols(m) * multipliers;
  fields.multipliers = layout_.named(multipliers);
  return fields;
}

std::array<double, model::num_constraints> SemiImplicitProblem::functionals(
    const problem::Fields& fields) const {
  return problem::constraint_values(model_.at(0), *triangulation_, fields.positions,
                                    fields.order_parameter, threads_);
}

Eigen::VectorXd SemiImplicitProblem::constraint_errors(const problem::Fields& fields,
                                                       double time) const {
  const auto measured = functionals(fields);
  const auto& targets = model_.targets;
  Eigen::VectorXd errors(layout_.num_multipliers());
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout_.multiplier(i) >= 0)
      errors[layout_.multiplier(i)] = measured[at(i)] - targets[at(i)]->value(time);
  }
  return errors;
}

Eigen::VectorXd SemiImplicitProblem::constraint_scales(const problem::Fields& fields,
                                                       double time) const {
  const double area = functionals(fields)[model::place_of<model::Constraints, model::Area>];
  const auto& targets = model_.targets;
  Eigen::VectorXd scales(layout_.num_multipliers());
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    const int row = layout_.multiplier(static_cast<int>(place));
    if (row < 0) return;
    const double target = std::abs(targets[place]->value(time));
    scales[row] = target > 0 ? target : model::error_scale<Constraint>(target, area);
  });
  return scales;
}

Eigen::MatrixXd SemiImplicitProblem::constraint_slopes(const problem::Fields& fields,
                                                       const SemiImplicitSolution& solution) const {
  const auto m = layout_.num_multipliers();
  const auto physics = model_.at(0);
  const auto directions = problem::shared_directions(physics, *triangulation_, fields.positions);
  std::vector<Slopes> elements(at(triangulation_->num_triangles()), Slopes::Zero());
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto& triangle = triangulation_->triangles()[at(t)];
      const auto element = element_values(fields, triangle);
      for (const auto& point : fem::triangle_rule()) {
        const auto in = problem::point_inputs(element, point.shape);
        const auto frame = fem::tangent_frame(in.x_u, in.x_v);
        const auto surface = problem::surface_point(in, frame, {});
        for (Eigen::Index column = 0; column < m; ++column) {
          const auto change = displacement_at(solution, 1 + column, block_size(), triangle,
                                              point.shape, frame.normal);
          model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t row) {
            if constexpr (model::LocalTerm<Constraint>) {
              const auto v = model::variation_of_term<Constraint>(physics.material, surface);
              elements[at(t)](row, column) += point.weight * frame.area_element *
                                              (v.a * change.normal + v.s * change.order_parameter);
            }
          });
        }
      }
      add_curved_slopes(physics, fields, solution, block_size(), triangle, directions,
                        elements[at(t)]);
    }
  });
  Slopes sum = Slopes::Zero();
  for (const auto& element : elements) sum += element;
  Eigen::MatrixXd result(m, m);
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout_.multiplier(i) >= 0) result.row(layout_.multiplier(i)) = sum.row(i).head(m);
  }
  return result;
}

}  // namespace vesica::paper
