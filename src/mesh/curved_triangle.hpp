#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// One quadratic triangle as a polynomial,
/// x(u, v) = a_0 + a_1 u + a_2 v + a_3 u^2 + a_4 u v + a_5 v^2.
class CurvedTriangle {
 public:
  struct ClosestPoint {
    Eigen::Vector2d parameters;
    double squared_distance;
  };

  CurvedTriangle(const QuadraticTriangle& nodes, const Positions& positions);

  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector2d& p) const;
  /// x_u x x_v, not normalised.
  [[nodiscard]] Eigen::Vector3d area_vector(const Eigen::Vector2d& p) const;
  /// Contains the curved triangle: the box around its six Bezier control points.
  [[nodiscard]] Eigen::AlignedBox3d box() const;

  /// Minimises |x(u, v) - target| over the triangle, from the node that is closest to it. Each step
  /// minimises a quadratic model over the triangle: Newton's, or Gauss-Newton's where that is not
  /// convex.
  [[nodiscard]] ClosestPoint closest(const Eigen::Vector3d& target) const;

 private:
  [[nodiscard]] Eigen::Vector3d derivative_u(const Eigen::Vector2d& p) const {
    return a_[1] + 2 * p.x() * a_[3] + p.y() * a_[4];
  }
  [[nodiscard]] Eigen::Vector3d derivative_v(const Eigen::Vector2d& p) const {
    return a_[2] + p.x() * a_[4] + 2 * p.y() * a_[5];
  }
  [[nodiscard]] Eigen::Vector2d closest_node(const Eigen::Vector3d& target) const;
  /// Where the quadratic model around `p` of half the squared distance is smallest, `offset` =
  /// x(p) - target.
  [[nodiscard]] Eigen::Vector2d model_minimum(const Eigen::Vector2d& p,
                                              const Eigen::Vector3d& offset) const;

  std::array<Eigen::Vector3d, 6> a_;
};

}  // namespace vesica::mesh
