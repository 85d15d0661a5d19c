#include "vesica/linalg/sparse_cholesky.hpp"

#include <Eigen/SparseCholesky>
#include <cassert>

#include "node_ordering.hpp"
#include "vesica/core/error.hpp"

namespace vesica::linalg {

namespace {

using EigenMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, SparseIndex>;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, SparseIndex>;

auto view(const SparseMatrix& matrix) {
  return Eigen::Map<const EigenMatrix>(matrix.size, matrix.size, matrix.num_nonzeros(),
                                       matrix.column_starts.data(), matrix.rows.data(),
                                       matrix.values.data());
}

/// The permutation that takes unknown order[k] to place k.
Permutation to_permutation(const std::vector<SparseIndex>& order) {
  Permutation permutation(static_cast<Eigen::Index>(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k)
    permutation.indices()[order[k]] = static_cast<SparseIndex>(k);
  return permutation;
}

}  // namespace

struct SparseCholesky::Factors {
  Permutation permutation;
  EigenMatrix permuted;
  Eigen::SimplicialLLT<EigenMatrix, Eigen::Lower, Eigen::NaturalOrdering<SparseIndex>> lower;

  void permute(const SparseMatrix& matrix) {
    permuted.selfadjointView<Eigen::Lower>() =
        view(matrix).selfadjointView<Eigen::Lower>().twistedBy(permutation);
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& pattern)
    : factors_(std::make_unique<Factors>()) {
  factors_->permutation = to_permutation(node_ordering(pattern, 1));
  factors_->permuted.resize(pattern.size, pattern.size);
  factors_->permute(pattern);
  factors_->lower.analyzePattern(factors_->permuted);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::factorise(const SparseMatrix& matrix) {
  factors_->permute(matrix);
  factors_->lower.factorize(factors_->permuted);
  if (factors_->lower.info() != Eigen::Success)
    throw RecoverableError("Cholesky factorisation: the matrix is not positive definite");
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  return solve_transposed(solve_factor(b));
}

Eigen::VectorXd SparseCholesky::multiply(const Eigen::VectorXd& y) const {
  return factors_->permutation.transpose() * (factors_->lower.matrixL() * y).eval();
}

Eigen::VectorXd SparseCholesky::multiply_transposed(const Eigen::VectorXd& x) const {
  return factors_->lower.matrixU() * (factors_->permutation * x).eval();
}

Eigen::VectorXd SparseCholesky::solve_factor(const Eigen::VectorXd& b) const {
  return factors_->lower.matrixL().solve(factors_->permutation * b);
}

Eigen::VectorXd SparseCholesky::solve_transposed(const Eigen::VectorXd& y) const {
  return factors_->permutation.transpose() * factors_->lower.matrixU().solve(y).eval();
}

}  // namespace vesica::linalg
