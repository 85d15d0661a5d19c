#include "sub_triangles.hpp"

#include <Eigen/Geometry>

namespace vesica::mesh {
namespace {

/// Gauss-Legendre rule on [0, 1], exact for degree 5.
constexpr std::array<double, 3> gauss_points = {0.11270166537925831, 0.5, 0.88729833462074169};
constexpr std::array<double, 3> gauss_weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

using Shape = std::array<double, 6>;

Shape shape_values(double u, double v) {
  const double w = 1 - u - v;
  return {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w};
}
Shape shape_u(double u, double v) {
  const double w = 1 - u - v;
  return {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v};
}
Shape shape_v(double u, double v) {
  const double w = 1 - u - v;
  return {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)};
}

Eigen::Vector3d combine(const Shape& shape, const QuadraticTriangle& nodes,
                        const Positions& positions) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 6; ++i) sum += shape[i] * positions.row(nodes[i]).transpose();
  return sum;
}

}  // namespace

std::array<Eigen::Vector3d, 3> sub_triangle(const QuadraticTriangle& nodes,
                                            const std::array<std::size_t, 3>& local,
                                            const Positions& positions) {
  return {positions.row(nodes[local[0]]), positions.row(nodes[local[1]]),
          positions.row(nodes[local[2]])};
}

Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

double volume_below(const QuadraticTriangle& nodes, const Positions& positions) {
  // The integrand has degree 4; collapsing the square onto the triangle (v = (1 - u) t) makes it 5.
  double integral = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double u = gauss_points[i];
      const double v = (1 - u) * gauss_points[j];
      const Eigen::Vector3d x = combine(shape_values(u, v), nodes, positions);
      const Eigen::Vector3d x_u = combine(shape_u(u, v), nodes, positions);
      const Eigen::Vector3d x_v = combine(shape_v(u, v), nodes, positions);
      integral += gauss_weights[i] * gauss_weights[j] * (1 - u) * x.dot(x_u.cross(x_v));
    }
  }
  return integral / 3;
}

}  // namespace vesica::mesh
