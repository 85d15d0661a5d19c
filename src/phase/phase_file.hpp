#pragma once

#include <Eigen/Core>
#include <string>

namespace vesica::phase {

/// Reads an order parameter: one finite number a line in node order; `#` starts a comment, empty
/// lines are passed over. Throws IoError when the file cannot be read and ConfigError with file and
/// line when it is malformed or has not one value for each of the nodes.
[[nodiscard]] Eigen::VectorXd read_phase_file(const std::string& path, Eigen::Index num_nodes);

}  // namespace vesica::phase
