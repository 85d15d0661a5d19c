#include "vesica/linalg/sparse_matrix.hpp"

#include <algorithm>

namespace vesica::linalg {

void SparseMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t column = 0; column < static_cast<std::size_t>(size); ++column) {
    for (auto k = column_starts[column]; k < column_starts[column + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      y[static_cast<std::size_t>(rows[entry])] += values[entry] * x[column];
    }
  }
}

}  // namespace vesica::linalg
