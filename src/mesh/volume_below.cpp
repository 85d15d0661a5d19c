#include "volume_below.hpp"

#include <Eigen/Geometry>
#include <array>

#include "vesica/mesh/quadratic_shape.hpp"

namespace vesica::mesh {
namespace {

/// Gauss-Legendre rule on [0, 1], exact for degree 5.
constexpr std::array<double, 3> gauss_points = {0.11270166537925831, 0.5, 0.88729833462074169};
constexpr std::array<double, 3> gauss_weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

Eigen::Vector3d combine(const std::array<double, 6>& shape, const QuadraticTriangle& nodes,
                        const Positions& positions) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 6; ++i) sum += shape[i] * positions.row(nodes[i]).transpose();
  return sum;
}

}  // namespace

double volume_below(const QuadraticTriangle& nodes, const Positions& positions) {
  // The integrand has degree 4; collapsing the square onto the triangle (v = (1 - u) t) makes it 5.
  double integral = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double u = gauss_points[i];
      const double v = (1 - u) * gauss_points[j];
      const ShapeValues shape = shape_values(u, v);
      const Eigen::Vector3d x = combine(shape.value, nodes, positions);
      const Eigen::Vector3d x_u = combine(shape.du, nodes, positions);
      const Eigen::Vector3d x_v = combine(shape.dv, nodes, positions);
      integral += gauss_weights[i] * gauss_weights[j] * (1 - u) * x.dot(x_u.cross(x_v));
    }
  }
  return integral / 3;
}

}  // namespace vesica::mesh
