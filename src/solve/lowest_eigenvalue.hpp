#pragma once

#include <Eigen/Core>
#include <functional>

namespace vesica::solve {

/// An eigenvalue of a symmetric operator with its eigenvector, of length 1.
struct Eigenpair {
  double value = 0;
  Eigen::VectorXd vector;
  double error = 0;  ///< an eigenvalue of the operator is this near
  int products = 0;
};

/// Finds the lowest eigenvalue of a symmetric operator by Lanczos' method from a random vector.
/// Ends when the error is below a tenth of the modulus, or of `resolution` where that is more, or
/// at 240 vectors: the sign is wanted rather than the digits.
[[nodiscard]] Eigenpair lowest_eigenvalue(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product, Eigen::Index size,
    double resolution);

}  // namespace vesica::solve
