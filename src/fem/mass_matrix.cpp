#include "vesica/fem/mass_matrix.hpp"

#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::fem {

namespace {

constexpr double relative_tolerance = 1e-11;
constexpr int max_iterations = 200;

/// The three columns side by side, padded to a vector register.
using Row = Eigen::Array4d;
using Rows = std::vector<Row>;

/// y = M x; returns the column-wise x . y.
Row multiply(const MassMatrix& mass, const Rows& x, Rows& y) {
  Row product = Row::Zero();
  const double* value = mass.values.data();
  for (std::int32_t node = 0; node < mass.graph.num_nodes(); ++node) {
    Row sum = Row::Zero();
    for (const auto neighbour : mass.graph.neighbours(node))
      sum += *value++ * x[static_cast<std::size_t>(neighbour)];
    y[static_cast<std::size_t>(node)] = sum;
    product += sum * x[static_cast<std::size_t>(node)];
  }
  return product;
}

/// a / b where b > 0, else 0: a column that has converged to zero stays there.
Row guarded_ratio(const Row& a, const Row& b) { return (b > 0).select(a / b, 0.0); }

}  // namespace

MassMatrix gather_mass_matrix(const NodeGraph& graph, const std::vector<double>& element_matrices,
                              int threads) {
  MassMatrix mass{graph, std::vector<double>(static_cast<std::size_t>(graph.num_pairs())),
                  std::vector<double>(static_cast<std::size_t>(graph.num_nodes()))};
  parallel_for(graph.num_nodes(), threads, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      auto pair = graph.first_pair(node);
      for (const auto neighbour : graph.neighbours(node)) {
        double sum = 0;
        for (const auto code : graph.contributions(pair))
          sum += element_matrices[static_cast<std::size_t>(code)];
        mass.values[static_cast<std::size_t>(pair++)] = sum;
        if (neighbour == node) mass.inverse_diagonal[static_cast<std::size_t>(node)] = 1 / sum;
      }
    }
  });
  return mass;
}

NodalTriple solve_mass_matrix(const MassMatrix& mass, const NodalTriple& rhs) {
  const auto n = static_cast<std::size_t>(rhs.rows());
  Rows x(n), residual(n), direction(n), product(n);
  Row rho = Row::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    residual[i] << rhs.row(static_cast<Eigen::Index>(i)).transpose().array(), 0;
    x[i] = Row::Zero();
    direction[i] = mass.inverse_diagonal[i] * residual[i];
    rho += residual[i] * direction[i];
  }
  const Row goal = rho * (relative_tolerance * relative_tolerance);
  int iteration = 0;
  while (!(rho <= goal).all()) {
    if (++iteration > max_iterations || !rho.allFinite()) {
      throw RecoverableError(
          "mass matrix: conjugate gradients do not converge, an element is degenerate");
    }
    const Row step = guarded_ratio(rho, multiply(mass, direction, product));
    Row next = Row::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * direction[i];
      residual[i] -= step * product[i];
      next += mass.inverse_diagonal[i] * residual[i].square();
    }
    const Row ratio = guarded_ratio(next, rho);
    for (std::size_t i = 0; i < n; ++i)
      direction[i] = mass.inverse_diagonal[i] * residual[i] + ratio * direction[i];
    rho = next;
  }
  NodalTriple result(rhs.rows(), 3);
  for (std::size_t i = 0; i < n; ++i)
    result.row(static_cast<Eigen::Index>(i)) = x[i].head<3>().matrix().transpose();
  return result;
}

}  // namespace vesica::fem
