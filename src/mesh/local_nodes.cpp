#include "vesica/mesh/local_nodes.hpp"

#include <Eigen/Geometry>

namespace vesica::mesh {

std::array<Eigen::Vector3d, 3> sub_triangle(const QuadraticTriangle& nodes,
                                            const std::array<std::size_t, 3>& local,
                                            const Positions& positions) {
  return {positions.row(nodes[local[0]]), positions.row(nodes[local[1]]),
          positions.row(nodes[local[2]])};
}

Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

}  // namespace vesica::mesh
