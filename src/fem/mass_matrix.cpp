#include "vesica/fem/mass_matrix.hpp"

#include <Eigen/IterativeLinearSolvers>

#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::fem {

namespace {

constexpr double relative_tolerance = 1e-11;
constexpr int max_iterations = 200;

}  // namespace

MassMatrix gather_mass_matrix(const NodeGraph& graph, const std::vector<double>& element_matrices,
                              int threads) {
  MassMatrix mass(graph.num_nodes(), graph.num_nodes());
  mass.resizeNonZeros(graph.num_pairs());
  mass.outerIndexPtr()[graph.num_nodes()] = static_cast<std::int32_t>(graph.num_pairs());
  parallel_for(graph.num_nodes(), threads, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      auto pair = graph.first_pair(node);
      mass.outerIndexPtr()[node] = static_cast<std::int32_t>(pair);
      for (const auto neighbour : graph.neighbours(node)) {
        double sum = 0;
        for (const auto code : graph.contributions(pair))
          sum += element_matrices[static_cast<std::size_t>(code)];
        mass.innerIndexPtr()[pair] = neighbour;
        mass.valuePtr()[pair++] = sum;
      }
    }
  });
  return mass;
}

NodalTriple solve_mass_matrix(const MassMatrix& mass, const NodalTriple& rhs, int threads) {
  NodalTriple result(rhs.rows(), 3);
  parallel_for(3, threads, [&](int begin, int end) {
    Eigen::ConjugateGradient<MassMatrix, Eigen::Lower | Eigen::Upper> solver(mass);
    solver.setTolerance(relative_tolerance);
    solver.setMaxIterations(max_iterations);
    for (int column = begin; column < end; ++column) {
      const Eigen::VectorXd b = rhs.col(column);
      const Eigen::VectorXd x = solver.solve(b);
      if (solver.info() != Eigen::Success) {
        throw RecoverableError(
            "mass matrix: conjugate gradients do not converge, an element is degenerate");
      }
      result.col(column) = x;
    }
  });
  return result;
}

}  // namespace vesica::fem
