#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vesica/mesh/surface_locator.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// A point of a surface from which the other one is looked at.
struct Probe {
  Eigen::Vector3d position;
  double weight = 0;           ///< of the quadrature [length^2]
  double order_parameter = 0;  ///< 0 for a single-phase vesicle
};

/// The nearest point of a surface.
struct Contact {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double order_parameter = 0;
  Eigen::Vector3d order_parameter_gradient = Eigen::Vector3d::Zero();  ///< along the surface
};

/// A surface that can be looked at and looked from. `state` must outlive it.
class SurfaceProbe {
 public:
  explicit SurfaceProbe(const problem::State& state);

  [[nodiscard]] const problem::State& state() const { return state_; }
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] const Eigen::Vector3d& centroid() const { return centroid_; }
  /// int (x - centroid) (x - centroid)^T / area [length^2].
  [[nodiscard]] const Eigen::Matrix3d& variance() const { return variance_; }
  /// The quadrature points.
  [[nodiscard]] std::span<const Probe> points() const { return points_; }
  /// About `count` triangle centres spread over the mesh, or all of them if there are fewer.
  [[nodiscard]] std::vector<Probe> some_points(std::size_t count) const;
  [[nodiscard]] Contact closest(const Eigen::Vector3d& point) const;
  [[nodiscard]] double distance(const Eigen::Vector3d& point) const;

 private:
  const problem::State& state_;
  mesh::SurfaceLocator locator_;
  std::vector<Probe> points_;
  double area_ = 0;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d variance_ = Eigen::Matrix3d::Zero();
};

}  // namespace vesica::measure
