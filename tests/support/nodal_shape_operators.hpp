#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "vesica/fem/recovery.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::test {

/// Q_h at all nodes of a surface.
inline fem::NodalShapeOperator recovered(const mesh::Surface& surface, int threads = 1) {
  const fem::NodeGraph graph(*surface.triangulation);
  return fem::recover_shape_operator(*surface.triangulation, graph, surface.positions, threads);
}

inline Eigen::Matrix3d tensor(const fem::NodalShapeOperator& q, Eigen::Index node) {
  Eigen::Matrix3d m;
  m << q(node, 0), q(node, 3), q(node, 5), q(node, 3), q(node, 1), q(node, 4), q(node, 5),
      q(node, 4), q(node, 2);
  return m;
}

inline Eigen::Matrix3d sphere_shape_operator(const Eigen::Vector3d& x) {
  const Eigen::Vector3d normal = x.normalized();
  return (Eigen::Matrix3d::Identity() - normal * normal.transpose()) / x.norm();
}

/// Torus around the z axis with the given distance of the tube's middle from the centre.
inline Eigen::Matrix3d torus_shape_operator(const Eigen::Vector3d& x, double major_radius) {
  const Eigen::Vector3d radial = Eigen::Vector3d(x.x(), x.y(), 0).normalized();
  const Eigen::Vector3d out = x - major_radius * radial;
  const Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(radial);
  const Eigen::Vector3d around = along.cross(out.normalized());
  const double distance = std::hypot(x.x(), x.y());
  const double cosine = out.normalized().dot(radial);
  return around * around.transpose() / out.norm() + cosine / distance * along * along.transpose();
}

/// nu = grad g / |grad g| and Q = P (D^2 g / |grad g|) P of the ellipsoid g = sum (x_i / a_i)^2.
inline Eigen::Matrix3d ellipsoid_shape_operator(const Eigen::Vector3d& x,
                                                const Eigen::Vector3d& semi_axes) {
  const Eigen::Vector3d inverse_squares = semi_axes.cwiseProduct(semi_axes).cwiseInverse();
  const Eigen::Vector3d gradient = 2 * x.cwiseProduct(inverse_squares);
  const Eigen::Vector3d normal = gradient.normalized();
  const Eigen::Matrix3d p = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const Eigen::Matrix3d hessian = Eigen::Vector3d(2 * inverse_squares).asDiagonal();
  return p * hessian * p / gradient.norm();
}

/// Root mean square over the nodes of |Q_h - exact(x)|.
template <class Exact>
double shape_operator_error(const mesh::Surface& surface, const Exact& exact) {
  const auto q = recovered(surface);
  double sum = 0;
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const Eigen::Vector3d x = surface.positions.row(i);
    sum += (tensor(q, i) - exact(x)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(q.rows()));
}

}  // namespace vesica::test
