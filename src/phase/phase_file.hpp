#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vesica/mesh/point_field.hpp"
#include "vesica/mesh/triangulation.hpp"
#include "vesica/phase/initial_phase.hpp"

namespace vesica::phase {

/// Numbers that are to become an order parameter, and where they stand.
struct GivenNumbers {
  std::string source;
  std::vector<double> values;
  std::vector<int> lines;  ///< of the file, from 1; empty: the numbers of a point field
  int last_line = 0;

  /// "phase.txt:12" or "surface.ply: point field 'c': value number 12".
  [[nodiscard]] std::string place(std::size_t i) const;
};

/// Reads one finite number a line; `#` starts a comment, empty lines are passed over. Throws
/// IoError when the file cannot be read and ConfigError with file and line when it is malformed.
[[nodiscard]] GivenNumbers read_phase_file(const std::string& path);

[[nodiscard]] GivenNumbers numbers_of(const mesh::PointField& field);

/// Makes an order parameter of the numbers by the rules that PhaseOptions tells. Throws ConfigError
/// with the place of the first number that breaks one.
[[nodiscard]] PhaseStart order_parameter_of(const GivenNumbers& given,
                                            const mesh::Triangulation& triangulation);

}  // namespace vesica::phase
