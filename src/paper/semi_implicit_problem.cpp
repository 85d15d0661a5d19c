#include "vesica/paper/semi_implicit_problem.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "semi_implicit_kernel.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::paper {

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

void SemiImplicitProblem::assemble(const SemiImplicitSettings& settings,
                                   const problem::Fields& fields,
                                   const fem::NodalShapeOperator& shape_operator,
                                   SemiImplicitSystem& system) const {
  const double ratio = settings.damping / settings.time_step;
  const double scale = tangential_ == TangentialVelocity::fields ? std::sqrt(ratio) : ratio;
  const auto physics = model_.at(settings.time);
  const SemiImplicitContext context{{physics, settings.damping, {}},
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

}  // namespace vesica::paper
