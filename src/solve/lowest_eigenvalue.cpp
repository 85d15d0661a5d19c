#include "lowest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>

#include "lanczos.hpp"

namespace vesica::solve {

namespace {

constexpr Eigen::Index min_dimension = 20;  // a start poor in the lowest mode may settle before
constexpr Eigen::Index max_dimension = 240;
constexpr Eigen::Index dimensions_between_looks = 10;
constexpr double relative_error = 0.1;

}  // namespace

Eigenpair lowest_eigenvalue(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                            Eigen::Index size, double resolution) {
  const auto last = std::min(max_dimension, size);
  Lanczos lanczos(product, {}, size, last);
  Eigenpair result;
  for (;;) {
    const auto dimension = lanczos.dimension();
    const auto eigen = lanczos.projected();
    result.value = eigen.values[0];
    result.error = lanczos.remainder() * std::abs(eigen.vectors(dimension - 1, 0));
    const double wanted = relative_error * std::max(std::abs(result.value), resolution);
    if (dimension == last || (dimension >= min_dimension && result.error < wanted)) {
      result.vector = lanczos.vector(eigen.vectors.col(0));
      result.products = lanczos.num_products();
      return result;
    }
    lanczos.extend(std::min(last, dimension + dimensions_between_looks));
  }
}

}  // namespace vesica::solve
