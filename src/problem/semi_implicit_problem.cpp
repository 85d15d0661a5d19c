#include "vesica/problem/semi_implicit_problem.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "constraint_kernel.hpp"
#include "semi_implicit_kernel.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::problem {

namespace {

constexpr std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// One entry of the 6 x 6 or 4 x 4 block of two nodes, in its column: a combination of two pair
/// integrals.
struct BlockEntry {
  std::size_t row;
  std::size_t first;
  double first_scale;
  std::size_t second = 0;
  double second_scale = 0;
};

/// Every column of J^m has four entries a block: x_k couples to itself, kappa and both beta (or to
/// x and kappa), the others to x and to themselves.
using BlockColumn = std::array<BlockEntry, 4>;
constexpr std::size_t entries_per_column = 4;

std::vector<BlockColumn> block_columns(TangentialVelocity tangential, double scale) {
  using namespace pair;
  std::vector<BlockColumn> columns;
  if (tangential == TangentialVelocity::fields) {
    for (std::size_t k = 0; k < 3; ++k) {
      columns.push_back({{{k, stiffness, 1},
                          {3, normal + k, 1},
                          {4, pair::tangential + k, scale},
                          {5, pair::tangential + 3 + k, scale}}});
    }
  } else {
    constexpr std::array<std::array<std::size_t, 3>, 3> symmetric{
        {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    for (std::size_t k = 0; k < 3; ++k) {
      BlockColumn column{};
      for (std::size_t r = 0; r < 3; ++r) {
        column[r] = {r, stiffness, r == k ? 1.0 : 0.0, pair::tangential + symmetric[r][k], scale};
      }
      column[3] = {3, normal + k, 1};
      columns.push_back(column);
    }
  }
  columns.push_back({{{0, normal, 1}, {1, normal + 1, 1}, {2, normal + 2, 1}, {3, bending, -1}}});
  if (tangential == TangentialVelocity::eliminated) return columns;
  for (std::size_t mu = 0; mu < 2; ++mu) {
    const std::size_t t = pair::tangential + 3 * mu;
    columns.push_back({{{0, t, scale}, {1, t + 1, scale}, {2, t + 2, scale}, {4 + mu, mass, -1}}});
  }
  return columns;
}

linalg::SparseMatrix geometry_pattern(const fem::NodeGraph& graph,
                                      const std::vector<BlockColumn>& columns) {
  const auto block = static_cast<linalg::SparseIndex>(columns.size());
  linalg::SparseMatrix matrix;
  matrix.size = graph.num_nodes() * block;
  matrix.column_starts.push_back(0);
  for (std::int32_t node = 0; node < graph.num_nodes(); ++node) {
    for (const auto& column : columns) {
      for (const auto neighbour : graph.neighbours(node)) {
        for (const auto& entry : column)
          matrix.rows.push_back(neighbour * block + static_cast<linalg::SparseIndex>(entry.row));
      }
      matrix.column_starts.push_back(static_cast<linalg::SparseIndex>(matrix.rows.size()));
    }
  }
  matrix.values.assign(matrix.rows.size(), 0.0);
  return matrix;
}

std::array<std::optional<model::Ramp>, 3> ramps(const model::Targets& targets) {
  return {targets.volume, targets.area, targets.phase_difference};
}

ElementNodes<double> element_nodes(const Fields& fields, const mesh::QuadraticTriangle& triangle) {
  ElementNodes<double> nodes;
  const bool is_two_phase = fields.order_parameter.size() > 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto node = triangle[i];
    nodes.x[i] = {fields.positions(node, 0), fields.positions(node, 1), fields.positions(node, 2)};
    nodes.c[i] = is_two_phase ? fields.order_parameter[node] : 1;
  }
  return nodes;
}

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

bool is_finite(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += 0 * value;
  return sum == 0;
}

}  // namespace

SemiImplicitProblem::SemiImplicitProblem(std::shared_ptr<const mesh::Triangulation> triangulation,
                                         model::Model model, TangentialVelocity tangential,
                                         int threads)
    : triangulation_(std::move(triangulation)),
      model_(std::move(model)),
      graph_(*triangulation_),
      layout_(triangulation_->num_nodes(), model_),
      tangential_(tangential),
      threads_(resolved_threads(threads)) {}

int SemiImplicitProblem::block_size() const {
  return tangential_ == TangentialVelocity::fields ? 6 : 4;
}

SemiImplicitSystem SemiImplicitProblem::make_system() const {
  SemiImplicitSystem system;
  const auto sides = 1 + layout_.num_multipliers();
  system.geometry = geometry_pattern(graph_, block_columns(tangential_, 1));
  system.geometry_sides = Eigen::MatrixXd::Zero(layout_.num_nodes() * block_size(), sides);
  if (!layout_.is_two_phase()) return system;
  system.phase = graph_.block_pattern(1);
  system.phase_sides = Eigen::MatrixXd::Zero(layout_.num_nodes(), sides);
  return system;
}

fem::NodalShapeOperator SemiImplicitProblem::shape_operator(
    const mesh::Positions& positions) const {
  return fem::recover_shape_operator(*triangulation_, graph_, positions, threads_);
}

void SemiImplicitProblem::assemble(const SemiImplicitSettings& settings, const Fields& fields,
                                   const fem::NodalShapeOperator& shape_operator,
                                   SemiImplicitSystem& system) const {
  const double ratio = settings.damping / settings.time_step;
  const double scale = tangential_ == TangentialVelocity::fields ? std::sqrt(ratio) : ratio;
  const SemiImplicitContext context{{model_, settings.damping, {}},
                                    shape_operator,
                                    fields,
                                    settings.time_step,
                                    scale,
                                    tangential_};
  constexpr std::size_t pair_size = num_node_pairs * pair::count;
  constexpr std::size_t side_size = 6 * side::count;
  const auto num_triangles = triangulation_->num_triangles();
  std::vector<double> pairs(at(num_triangles) * pair_size);
  std::vector<double> sides(at(num_triangles) * side_size);
  parallel_for(num_triangles, threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      PairIntegrals local_pairs{};
      NodeIntegrals local_nodes{};
      add_semi_implicit_element(context, triangulation_->triangles()[at(t)], local_pairs,
                                local_nodes);
      std::copy_n(local_pairs.front().data(), pair_size, &pairs[at(t) * pair_size]);
      std::copy_n(local_nodes.front().data(), side_size, &sides[at(t) * side_size]);
    }
  });
  if (!is_finite(pairs) || !is_finite(sides))
    throw RecoverableError("the equations are not finite: an element is degenerate");
  gather_matrices(pairs, scale, system);
  gather_sides(sides, system);
}

void SemiImplicitProblem::gather_matrices(const std::vector<double>& pairs, double tangential_scale,
                                          SemiImplicitSystem& system) const {
  const auto columns = block_columns(tangential_, tangential_scale);
  const auto block = columns.size();
  parallel_for(graph_.num_nodes(), threads_, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      const auto first_pair = graph_.first_pair(node);
      const auto count = graph_.neighbours(node).size();
      for (std::size_t q = 0; q < count; ++q) {
        std::array<double, pair::count> sum{};
        for (const auto code : graph_.contributions(first_pair + static_cast<std::int64_t>(q))) {
          const std::size_t triangle = at(code / 36);
          const std::size_t index = pair_index(at(code % 36 / 6), at(code % 6));
          const double* entry = &pairs[(triangle * num_node_pairs + index) * pair::count];
          for (std::size_t k = 0; k < pair::count; ++k) sum[k] += entry[k];
        }
        for (std::size_t c = 0; c < block; ++c) {
          double* values =
              &system.geometry.values[at(system.geometry.column_starts[at(node) * block + c])];
          for (std::size_t e = 0; e < entries_per_column; ++e) {
            const auto& entry = columns[c][e];
            values[q * entries_per_column + e] =
                entry.first_scale * sum[entry.first] + entry.second_scale * sum[entry.second];
          }
        }
        if (layout_.is_two_phase()) system.phase.values[at(first_pair) + q] = sum[pair::phase];
      }
    }
  });
}

void SemiImplicitProblem::gather_sides(const std::vector<double>& local,
                                       SemiImplicitSystem& system) const {
  const auto block = block_size();
  parallel_for(graph_.num_nodes(), threads_, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      std::array<double, side::count> sum{};
      for (const auto code : graph_.incidences(node)) {
        for (std::size_t k = 0; k < side::count; ++k) sum[k] += local[at(code) * side::count + k];
      }
      const Eigen::Index row = static_cast<Eigen::Index>(node) * block;
      for (int k = 0; k < block; ++k)
        system.geometry_sides(row + k, 0) = sum[side::geometry + at(k)];
      if (layout_.is_two_phase()) system.phase_sides(node, 0) = sum[side::phase];
      for (int i = 0; i < model::num_constraints; ++i) {
        const int column = 1 + layout_.multiplier(i);
        if (column == 0) continue;
        system.geometry_sides(row + 3, column) = sum[side::constraints + at(i)];
        if (layout_.is_two_phase())
          system.phase_sides(node, column) = sum[side::phase_constraints + at(i)];
      }
    }
  });
}

Fields SemiImplicitProblem::fields_at(const SemiImplicitSolution& solution,
                                      const Eigen::VectorXd& multipliers) const {
  const auto n = layout_.num_nodes();
  const auto m = layout_.num_multipliers();
  const Eigen::VectorXd y = solution.geometry.col(0) - solution.geometry.rightCols(m) * multipliers;
  Fields fields;
  fields.positions.resize(n, 3);
  fields.mean_curvature.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    fields.positions.row(i) = y.segment<3>(i * block_size()).transpose();
    fields.mean_curvature[i] = y[i * block_size() + 3];
  }
  if (layout_.is_two_phase())
    fields.order_parameter = solution.phase.col(0) - solution.phase.rightCols(m) * multipliers;
  const auto value = [&](int constraint) -> std::optional<double> {
    if (layout_.multiplier(constraint) < 0) return std::nullopt;
    return multipliers[layout_.multiplier(constraint)];
  };
  fields.multipliers = {value(0), value(1), value(2)};
  return fields;
}

std::array<double, model::num_constraints> SemiImplicitProblem::functionals(
    const Fields& fields) const {
  std::vector<std::array<double, model::num_constraints>> elements(
      at(triangulation_->num_triangles()));
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      elements[at(t)] = element_constraint_values(
          element_nodes(fields, triangulation_->triangles()[at(t)]), layout_.is_two_phase());
    }
  });
  std::array<double, model::num_constraints> sum{};
  for (const auto& element : elements) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += element[i];
  }
  return sum;
}

Eigen::VectorXd SemiImplicitProblem::constraint_errors(const Fields& fields, double time) const {
  const auto measured = functionals(fields);
  const auto targets = ramps(model_.targets);
  Eigen::VectorXd errors(layout_.num_multipliers());
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout_.multiplier(i) >= 0)
      errors[layout_.multiplier(i)] = measured[at(i)] - targets[at(i)]->value(time);
  }
  return errors;
}

Eigen::VectorXd SemiImplicitProblem::constraint_scales(const Fields& fields, double time) const {
  const double area = functionals(fields)[1];
  const auto targets = ramps(model_.targets);
  Eigen::VectorXd scales(layout_.num_multipliers());
  for (int i = 0; i < model::num_constraints; ++i) {
    if (layout_.multiplier(i) < 0) continue;
    const double target = std::abs(targets[at(i)]->value(time));
    scales[layout_.multiplier(i)] = target > 0 ? target : area;
  }
  return scales;
}

Eigen::MatrixXd SemiImplicitProblem::constraint_slopes(const Fields& fields,
                                                       const SemiImplicitSolution& solution) const {
  const auto m = layout_.num_multipliers();
  using Slopes = Eigen::Matrix<double, model::num_constraints, model::num_constraints>;
  std::vector<Slopes> elements(at(triangulation_->num_triangles()), Slopes::Zero());
  parallel_for(triangulation_->num_triangles(), threads_, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const auto& triangle = triangulation_->triangles()[at(t)];
      const auto element = element_values(fields, triangle);
      for (const auto& point : fem::triangle_rule()) {
        const auto in = point_inputs(element, point.shape);
        const auto frame = fem::tangent_frame(in.x_u, in.x_v);
        const auto surface = surface_point(in, frame, {});
        for (Eigen::Index column = 0; column < m; ++column) {
          const auto change = displacement_at(solution, 1 + column, block_size(), triangle,
                                              point.shape, frame.normal);
          Eigen::Index row = 0;
          const auto add = [&]<class Constraint>(const Constraint&) {
            const auto v = Constraint::variation(surface);
            elements[at(t)](row++, column) += point.weight * frame.area_element *
                                              (v.a * change.normal + v.s * change.order_parameter);
          };
          std::apply([&](const auto&... constraint) { (add(constraint), ...); },
                     model::Constraints{});
        }
      }
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

}  // namespace vesica::problem
