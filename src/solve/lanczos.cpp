#include "lanczos.hpp"

#include <Spectra/LinAlg/Lanczos.h>

#include <random>
#include <utility>

namespace vesica::solve {
namespace {

struct Product {
  using Scalar = double;
  Lanczos::Operator apply;
  Eigen::Index size;

  [[nodiscard]] Eigen::Index rows() const { return size; }
  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::VectorXd> z(in, size);
    Eigen::Map<Eigen::VectorXd> image(out, size);
    if (apply) {
      image = apply(z);
    } else {
      image = z;
    }
  }
};

}  // namespace

struct Lanczos::Krylov {
  using Operators = Spectra::ArnoldiOp<double, Product, Product>;

  Krylov(Operator given_product, Operator given_metric, Eigen::Index size, Eigen::Index largest)
      : product{std::move(given_product), size},
        metric{std::move(given_metric), size},
        spectra(Operators(product, metric), largest) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const Eigen::VectorXd start =
        Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(engine); });
    Eigen::Map<const Eigen::VectorXd> view(start.data(), size);
    spectra.init(view, num_products);
  }

  Product product;
  Product metric;
  Eigen::Index num_products = 0;
  Eigen::Index dimension = 1;
  Spectra::Lanczos<double, Operators> spectra;
};

Lanczos::Lanczos(Operator product, Operator metric, Eigen::Index size, Eigen::Index largest)
    : krylov_(std::make_unique<Krylov>(std::move(product), std::move(metric), size, largest)) {}

Lanczos::~Lanczos() = default;

void Lanczos::extend(Eigen::Index dimension) {
  if (dimension <= krylov_->dimension) return;
  krylov_->spectra.factorize_from(krylov_->dimension, dimension, krylov_->num_products);
  krylov_->dimension = dimension;
}

Eigen::Index Lanczos::dimension() const { return krylov_->dimension; }

linalg::Eigensystem Lanczos::projected() const {
  const auto size = krylov_->dimension;
  return linalg::symmetric_eigensystem(krylov_->spectra.matrix_H().topLeftCorner(size, size));
}

Eigen::VectorXd Lanczos::vector(const Eigen::VectorXd& coefficients) const {
  return krylov_->spectra.matrix_V().leftCols(krylov_->dimension) * coefficients;
}

double Lanczos::remainder() const { return krylov_->spectra.f_norm(); }

int Lanczos::num_products() const { return static_cast<int>(krylov_->num_products); }

}  // namespace vesica::solve
