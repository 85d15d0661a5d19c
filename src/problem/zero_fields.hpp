#pragma once

#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Returns fields that vanish at all nodes, without multipliers: the rates of a state at rest.
[[nodiscard]] inline Fields zero_fields(Eigen::Index num_nodes, bool is_two_phase) {
  return {mesh::Positions::Zero(num_nodes, 3),
          Eigen::VectorXd::Zero(num_nodes),
          Eigen::VectorXd::Zero(is_two_phase ? num_nodes : 0),
          {}};
}

}  // namespace vesica::problem
