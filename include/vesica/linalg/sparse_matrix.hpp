#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace vesica::linalg {

/// Index type of the sparse arrays, the one of UMFPACK's `dl` and KLU's `l` interfaces.
using SparseIndex = std::int64_t;

/// A sparse matrix in compressed columns, rows ascending within a column. The pattern is fixed once
/// made.
struct SparseMatrix {
  SparseIndex size = 0;                    ///< rows = columns
  std::vector<SparseIndex> column_starts;  ///< length size + 1
  std::vector<SparseIndex> rows;           ///< length num_nonzeros
  std::vector<double> values;              ///< length num_nonzeros

  [[nodiscard]] SparseIndex num_nonzeros() const { return static_cast<SparseIndex>(rows.size()); }
  /// Computes y = A x.
  void multiply(std::span<const double> x, std::span<double> y) const;
};

}  // namespace vesica::linalg
