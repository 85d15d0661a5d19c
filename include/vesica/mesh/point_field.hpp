#pragma once

#include <Eigen/Core>
#include <string>

namespace vesica::mesh {

/// Numbers that a file gives to the points of a surface: one a vertex, in the order of the
/// vertices, or one a node, in the order of the nodes.
struct PointField {
  std::string name;
  std::string source;  ///< what the numbers are called in messages: the file, with the field
  Eigen::VectorXd values;
};

}  // namespace vesica::mesh
