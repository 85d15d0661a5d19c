#include "vesica/fem/mass_matrix.hpp"

#include <algorithm>

#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::fem {

namespace {

constexpr int max_iterations = 200;
constexpr int rows_of_chunk = 1024;  // sums over chunks do not depend on the number of threads

using Row = Eigen::Array<double, 1, 4>;  // three columns and a zero: vector instructions
using Rows = Eigen::Array<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Adds what body(begin, end) returns for chunks of [0, count), on `threads` threads.
template <class Body>
Row sum_over_chunks(Eigen::Index count, int threads, const Body& body) {
  const auto chunks = static_cast<int>((count + rows_of_chunk - 1) / rows_of_chunk);
  Rows sums(chunks, 4);
  parallel_for(chunks, threads, [&](int begin, int end) {
    for (Eigen::Index chunk = begin; chunk < end; ++chunk) {
      sums.row(chunk) = body(chunk * rows_of_chunk, std::min(count, (chunk + 1) * rows_of_chunk));
    }
  });
  return sums.colwise().sum();
}

/// Computes product = M x in the rows [begin, end); returns the sum of x times product there.
Row multiply(const MassMatrix& mass, const Rows& x, Rows& product, Eigen::Index begin,
             Eigen::Index end) {
  const auto* starts = mass.outerIndexPtr();
  const auto* columns = mass.innerIndexPtr();
  const auto* values = mass.valuePtr();
  Row dot = Row::Zero();
  for (Eigen::Index i = begin; i < end; ++i) {
    Row sum = Row::Zero();
    for (auto k = starts[i]; k < starts[i + 1]; ++k) sum += values[k] * x.row(columns[k]);
    product.row(i) = sum;
    dot += sum * x.row(i);
  }
  return dot;
}

Row ratio(const Row& a, const Row& b) { return (b > 0).select(a / b, 0.0); }

Rows padded(const NodalTriple& columns) {
  Rows rows = Rows::Zero(columns.rows(), 4);
  rows.leftCols<3>() = columns.array();
  return rows;
}

/// Conjugate gradients for three columns side by side.
class ConjugateGradients {
 public:
  ConjugateGradients(const MassMatrix& mass, const NodalTriple& rhs, const NodalTriple& guess,
                     int threads)
      : mass_(mass),
        threads_(threads),
        inverse_diagonal_(mass.diagonal().cwiseInverse()),
        solution_(guess.rows() > 0 ? padded(guess) : Rows::Zero(rhs.rows(), 4)),
        residual_(padded(rhs)),
        direction_(rhs.rows(), 4),
        product_(rhs.rows(), 4) {
    const Rows right = residual_;
    size_ = for_rows(
        [&](Eigen::Index i) { return (inverse_diagonal_[i] * right.row(i).square()).eval(); });
    if (guess.rows() > 0) {
      sum_over_chunks(rhs.rows(), threads_, [&](Eigen::Index begin, Eigen::Index end) {
        return multiply(mass_, solution_, product_, begin, end);
      });
      residual_ -= product_;
    }
    rho_ = for_rows([&](Eigen::Index i) {
      direction_.row(i) = inverse_diagonal_[i] * residual_.row(i);
      return (residual_.row(i) * direction_.row(i)).eval();
    });
  }

  [[nodiscard]] bool is_converged(double tolerance) const {
    return (rho_ <= tolerance * tolerance * size_.maxCoeff()).all();
  }
  [[nodiscard]] bool is_finite() const { return rho_.allFinite(); }

  void iterate() {
    const Row curvature =
        sum_over_chunks(mass_.rows(), threads_, [&](Eigen::Index begin, Eigen::Index end) {
          return multiply(mass_, direction_, product_, begin, end);
        });
    const Row step = ratio(rho_, curvature);
    const Row next = for_rows([&](Eigen::Index i) {
      solution_.row(i) += step * direction_.row(i);
      residual_.row(i) -= step * product_.row(i);
      return (inverse_diagonal_[i] * residual_.row(i).square()).eval();
    });
    const Row growth = ratio(next, rho_);
    for_rows([&](Eigen::Index i) {
      direction_.row(i) = inverse_diagonal_[i] * residual_.row(i) + growth * direction_.row(i);
      return Row(Row::Zero());
    });
    rho_ = next;
  }

  [[nodiscard]] NodalTriple solution() const { return solution_.leftCols<3>(); }

 private:
  /// Adds body(i) over all rows.
  template <class Body>
  Row for_rows(const Body& body) const {
    return sum_over_chunks(mass_.rows(), threads_, [&](Eigen::Index begin, Eigen::Index end) {
      Row sum = Row::Zero();
      for (Eigen::Index i = begin; i < end; ++i) sum += body(i);
      return sum;
    });
  }

  const MassMatrix& mass_;
  int threads_;
  Eigen::VectorXd inverse_diagonal_;
  Rows solution_, residual_, direction_, product_;
  Row size_, rho_;
};

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

NodalTriple solve_mass_matrix(const MassMatrix& mass, const NodalTriple& rhs, int threads,
                              const NodalTriple& guess, double tolerance) {
  ConjugateGradients solver(mass, rhs, guess, threads);
  for (int iteration = 0; !solver.is_converged(tolerance); ++iteration) {
    if (iteration == max_iterations || !solver.is_finite()) {
      throw RecoverableError(
          "mass matrix: conjugate gradients do not converge, an element is degenerate");
    }
    solver.iterate();
  }
  return solver.solution();
}

}  // namespace vesica::fem
