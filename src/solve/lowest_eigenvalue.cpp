#include "lowest_eigenvalue.hpp"

#include <Spectra/LinAlg/Lanczos.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

namespace vesica::solve {

namespace {

constexpr Eigen::Index min_dimension = 20;  // a start poor in the lowest mode may settle before
constexpr Eigen::Index max_dimension = 240;
constexpr Eigen::Index dimensions_between_looks = 10;
constexpr double relative_error = 0.1;

struct Operator {
  using Scalar = double;
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product;
  Eigen::Index size;

  [[nodiscard]] Eigen::Index rows() const { return size; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, size) = product(Eigen::Map<const Eigen::VectorXd>(in, size));
  }
};

}  // namespace

Eigenpair lowest_eigenvalue(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                            Eigen::Index size, double resolution) {
  using Symmetric = Spectra::ArnoldiOp<double, Operator, Spectra::IdentityBOp>;
  const Operator op{product, size};
  const auto last = std::min(max_dimension, size);
  Spectra::Lanczos<double, Symmetric> krylov(Symmetric(op, {}), last);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::VectorXd start = Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(engine); });
  Eigen::Map<const Eigen::VectorXd> start_view(start.data(), size);
  Eigen::Index products = 0;
  krylov.init(start_view, products);
  Eigenpair result;
  for (Eigen::Index dimension = 1;;) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        krylov.matrix_H().topLeftCorner(dimension, dimension));
    result.value = eigen.eigenvalues()[0];
    result.error = krylov.f_norm() * std::abs(eigen.eigenvectors()(dimension - 1, 0));
    const double wanted = relative_error * std::max(std::abs(result.value), resolution);
    if (dimension == last || (dimension >= min_dimension && result.error < wanted)) {
      result.vector = krylov.matrix_V().leftCols(dimension) * eigen.eigenvectors().col(0);
      result.products = static_cast<int>(products);
      return result;
    }
    const auto next = std::min(last, dimension + dimensions_between_looks);
    krylov.factorize_from(dimension, next, products);
    dimension = next;
  }
}

}  // namespace vesica::solve
