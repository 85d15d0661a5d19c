#include "vesica/linalg/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <optional>

#include "vesica/core/error.hpp"

namespace vesica::linalg {
namespace {

/// Eigen's iterations need not end for numbers that are none.
const Eigen::MatrixXd& finite(const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite()) throw RecoverableError("a dense matrix is not finite");
  return matrix;
}

}  // namespace

Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::Index SingularSystem::rank(double threshold) const {
  if (values.size() == 0) return 0;
  return (values.array() > threshold * values[0]).count();
}

Eigen::VectorXd SingularSystem::solve(const Eigen::VectorXd& b, double threshold) const {
  const Eigen::Index count = rank(threshold);
  return right.leftCols(count) *
         (left.leftCols(count).transpose() * b).cwiseQuotient(values.head(count));
}

SingularSystem singular_system(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(finite(matrix),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

struct DenseLu::Factors {
  std::optional<Eigen::FullPivLU<Eigen::MatrixXd>> lu;
};

DenseLu::DenseLu() : factors_(std::make_unique<Factors>()) {}
DenseLu::~DenseLu() = default;
DenseLu::DenseLu(DenseLu&&) noexcept = default;
DenseLu& DenseLu::operator=(DenseLu&&) noexcept = default;

bool DenseLu::factorise(const Eigen::MatrixXd& matrix) {
  factors_->lu.reset();
  if (matrix.size() == 0) return true;
  factors_->lu.emplace(finite(matrix));
  return factors_->lu->matrixLU().diagonal().cwiseAbs().minCoeff() > 0;
}

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& b) const {
  if (b.size() == 0) return b;
  return factors_->lu->solve(b);
}

}  // namespace vesica::linalg
