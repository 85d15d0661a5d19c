#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <memory>
#include <span>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// A point of a surface of quadratic triangles: x(u, v) of one triangle (u, v, 1 - u - v >= 0,
/// order of nodes as in QuadraticTriangle).
struct SurfaceLocation {
  NodeIndex triangle = 0;
  double u = 0;
  double v = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< x(u, v) [length]
  double distance = 0;                              ///< from the point that was asked for [length]
};

/// Returns the values of the six quadratic shape functions at a location.
[[nodiscard]] std::array<double, 6> shape_weights(const SurfaceLocation& location);

/// Interpolates a nodal field, which has a row for each node, at a location: returns sum_i phi_i(u,
/// v) field_i as a column vector with an entry for each column of the field.
template <class Field>
[[nodiscard]] Eigen::Matrix<double, Field::ColsAtCompileTime, 1> interpolate(
    const Triangulation& triangulation, const SurfaceLocation& location,
    const Eigen::MatrixBase<Field>& field) {
  assert(field.rows() == triangulation.num_nodes());
  const QuadraticTriangle& nodes =
      triangulation.triangles()[static_cast<std::size_t>(location.triangle)];
  const std::array<double, 6> weights = shape_weights(location);
  Eigen::Matrix<double, Field::ColsAtCompileTime, 1> sum(field.cols());
  sum.setZero();
  for (std::size_t i = 0; i < 6; ++i) sum += weights[i] * field.row(nodes[i]).transpose();
  return sum;
}

/// Interpolates a nodal field at many locations; the result has a row for each.
template <class Field>
[[nodiscard]] typename Field::PlainObject interpolate(const Triangulation& triangulation,
                                                      std::span<const SurfaceLocation> locations,
                                                      const Eigen::MatrixBase<Field>& field) {
  typename Field::PlainObject values(static_cast<Eigen::Index>(locations.size()), field.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    values.row(i) =
        interpolate(triangulation, locations[static_cast<std::size_t>(i)], field).transpose();
  }
  return values;
}

/// Finds closest points on a surface of curved triangles: a tree of boxes around the triangles, and
/// Newton's method in (u, v) on each triangle that is near enough. Immutable; queries from several
/// threads are safe.
class SurfaceLocator {
 public:
  /// Makes the locator of a surface. Throws ConfigError when there is not one finite position for
  /// each node.
  SurfaceLocator(std::shared_ptr<const Triangulation> triangulation, Positions positions);

  /// Finds the closest point of the curved surface to `point`. On a triangle so strongly curved
  /// that the distance has several local minima it is the one next to the triangle's closest node.
  /// Throws ConfigError when `point` is not finite.
  [[nodiscard]] SurfaceLocation closest(const Eigen::Vector3d& point) const;

  /// Finds the closest point among the triangles whose normal at their closest point makes an angle
  /// below 90 degrees with `normal` (any length): a neck or a fold has two sheets near each other.
  /// Without such a triangle the plain closest point.
  [[nodiscard]] SurfaceLocation closest(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) const;

  /// Walks from the triangle of `start` over its neighbours as long as they come closer to `point`:
  /// a local minimum of the distance on the same sheet. Several times faster than `closest` for
  /// points within an element or two of `start`. `point` must be finite.
  [[nodiscard]] SurfaceLocation closest_from(const SurfaceLocation& start,
                                             const Eigen::Vector3d& point) const;

  /// Returns the outward unit normal x_u x x_v / |x_u x x_v| of the curved triangle.
  [[nodiscard]] Eigen::Vector3d normal(const SurfaceLocation& location) const;

  /// Calls mesh::interpolate with this triangulation.
  template <class Locations, class Field>
  [[nodiscard]] auto interpolate(const Locations& locations,
                                 const Eigen::MatrixBase<Field>& field) const {
    return mesh::interpolate(*triangulation_, locations, field);
  }

  [[nodiscard]] const Triangulation& triangulation() const { return *triangulation_; }
  [[nodiscard]] const Positions& positions() const { return positions_; }

 private:
  struct Index;

  std::shared_ptr<const Triangulation> triangulation_;
  Positions positions_;
  std::shared_ptr<const Index> index_;
};

}  // namespace vesica::mesh
