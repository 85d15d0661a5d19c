#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "vesica/linalg/dense.hpp"

namespace vesica::solve {

/// Lanczos' method for the extreme eigenvalues of an operator that is symmetric in an inner product
/// x^T M y, from a random vector with a fixed seed. It is Spectra's factorisation without its
/// restarts: few vectors suffice where one end of the spectrum is wanted.
class Lanczos {
 public:
  using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  /// `metric` is z -> M z; empty: the identity. No more than `largest` vectors will be asked for.
  Lanczos(Operator product, Operator metric, Eigen::Index size, Eigen::Index largest);
  ~Lanczos();
  Lanczos(const Lanczos&) = delete;
  Lanczos& operator=(const Lanczos&) = delete;

  /// Takes the Krylov space to so many vectors, at least as many as before.
  void extend(Eigen::Index dimension);
  [[nodiscard]] Eigen::Index dimension() const;
  /// Returns the eigenvalues and eigenvectors of the operator in the Krylov space, in its basis.
  [[nodiscard]] linalg::Eigensystem projected() const;
  /// Returns the vector with these coefficients in the basis.
  [[nodiscard]] Eigen::VectorXd vector(const Eigen::VectorXd& coefficients) const;
  /// Returns the norm of what the operator leads out of the Krylov space.
  [[nodiscard]] double remainder() const;
  [[nodiscard]] int num_products() const;

 private:
  struct Krylov;
  std::unique_ptr<Krylov> krylov_;
};

}  // namespace vesica::solve
