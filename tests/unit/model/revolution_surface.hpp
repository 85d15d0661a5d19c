#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "vesica/model/surface_functional.hpp"

namespace vesica::model {

/// Equidistant nodes t_j = (j + 1/2) 2 pi / n of a periodic parameter, with the Fourier
/// differentiation matrix.
struct PeriodicGrid {
  Eigen::ArrayXd t;
  Eigen::MatrixXd derivative;

  explicit PeriodicGrid(int n) : t(n), derivative(Eigen::MatrixXd::Zero(n, n)) {
    const double step = 2 * std::numbers::pi / n;
    for (int i = 0; i < n; ++i) {
      t[i] = (i + 0.5) * step;
      for (int j = 0; j < n; ++j) {
        if (i != j)
          derivative(i, j) = 0.5 * ((i - j) % 2 == 0 ? 1 : -1) / std::tan(0.5 * (i - j) * step);
      }
    }
  }
  [[nodiscard]] Eigen::ArrayXd differentiate(const Eigen::ArrayXd& f) const {
    return (derivative * f.matrix()).array();
  }
};

/// Weights of a closed profile: a torus, whose whole parameter circle is one turn of the tube, or a
/// sphere-like surface, r odd and z even in t, whose profile is t in (0, pi). Both rules are exact
/// to rounding for resolved integrands.
enum class ProfileKind { torus, sphere };

inline Eigen::ArrayXd profile_weights(const PeriodicGrid& grid, ProfileKind kind) {
  const auto n = grid.t.size();
  if (kind == ProfileKind::torus)
    return Eigen::ArrayXd::Constant(n, 2 * std::numbers::pi / static_cast<double>(n));
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(n);
  const auto half = n / 2;
  for (Eigen::Index j = 0; j < half; ++j) {  // integrates the sine interpolant of the odd integrand
    for (Eigen::Index k = 1; k < half; k += 2) {
      weights[j] +=
          4 / static_cast<double>(half * k) * std::sin(static_cast<double>(k) * grid.t[j]);
    }
  }
  return weights;
}

/// Surface of revolution with an order parameter: profile (r, z) so that (z', -r') points outwards.
struct Revolution {
  Eigen::ArrayXd r, z, c;
};

/// What the functionals see along the profile at azimuth 0 (the x-z plane); everything from the
/// samples by Fourier differentiation.
class SampledRevolution {
 public:
  SampledRevolution(const PeriodicGrid& grid, ProfileKind kind, const Revolution& shape)
      : grid_(grid),
        shape_(shape),
        r_t_(grid.differentiate(shape.r)),
        z_t_(grid.differentiate(shape.z)) {
    speed_ = (r_t_.square() + z_t_.square()).sqrt();
    normal_r_ = z_t_ / speed_;
    normal_z_ = -r_t_ / speed_;
    meridian_ = (grid.differentiate(normal_r_) * r_t_ + grid.differentiate(normal_z_) * z_t_) /
                speed_.square();
    azimuthal_ = normal_r_ / shape.r;
    area_weights_ = profile_weights(grid, kind) * 2 * std::numbers::pi * shape.r * speed_;
  }

  [[nodiscard]] const Eigen::ArrayXd& area_weights() const { return area_weights_; }
  [[nodiscard]] const Eigen::ArrayXd& normal_r() const { return normal_r_; }
  [[nodiscard]] const Eigen::ArrayXd& normal_z() const { return normal_z_; }

  /// Surface gradient of a function of t at node j from its derivative in t.
  [[nodiscard]] Vec3<double> gradient(double f_t, Eigen::Index j) const {
    const double factor = f_t / (speed_[j] * speed_[j]);
    return {factor * r_t_[j], 0, factor * z_t_[j]};
  }

  [[nodiscard]] Eigen::Array<SurfacePoint<double>, Eigen::Dynamic, 1> points() const {
    const Eigen::ArrayXd mean = -(meridian_ + azimuthal_);
    const Eigen::ArrayXd mean_t = grid_.differentiate(mean);
    const Eigen::ArrayXd c_t = grid_.differentiate(shape_.c);
    Eigen::Array<SurfacePoint<double>, Eigen::Dynamic, 1> points(mean.size());
    for (Eigen::Index j = 0; j < mean.size(); ++j) {
      auto& p = points[j];
      const double t_r = r_t_[j] / speed_[j];
      const double t_z = z_t_[j] / speed_[j];
      p.position = {shape_.r[j], 0, shape_.z[j]};
      p.normal = {normal_r_[j], 0, normal_z_[j]};
      p.mean_curvature = mean[j];
      p.mean_curvature_gradient = gradient(mean_t[j], j);
      p.shape_operator.xx = meridian_[j] * t_r * t_r;
      p.shape_operator.xz = meridian_[j] * t_r * t_z;
      p.shape_operator.zz = meridian_[j] * t_z * t_z;
      p.shape_operator.yy = azimuthal_[j];
      p.order_parameter = shape_.c[j];
      p.order_parameter_gradient = gradient(c_t[j], j);
    }
    return points;
  }

 private:
  const PeriodicGrid& grid_;
  const Revolution& shape_;
  Eigen::ArrayXd r_t_, z_t_, speed_, normal_r_, normal_z_;
  Eigen::ArrayXd meridian_, azimuthal_;  ///< principal curvatures, +1/R on a sphere
  Eigen::ArrayXd area_weights_;
};

}  // namespace vesica::model
