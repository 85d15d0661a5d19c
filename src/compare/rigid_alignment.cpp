#include "rigid_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vesica/core/parallel.hpp"

namespace vesica::compare {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A probe, what it sees, and which of the two points moves.
struct Sight {
  double weight = 0;
  Eigen::Vector3d gap;       ///< fixed point minus moving point
  Eigen::Vector3d moving;    ///< the point that moves with the second surface
  Eigen::Vector3d normal;    ///< at the contact
  double difference = 0;     ///< c_1 - c_2
  Eigen::Vector3d gradient;  ///< of the order parameter at the contact
};

Sight seen_from_first(const measure::Probe& probe, const measure::SurfaceProbe& second,
                      const RigidMotion& motion) {
  const measure::Contact contact = second.closest(motion.inverse_of(probe.position));
  const Eigen::Vector3d moving = motion.of(contact.position);
  return {probe.weight,
          probe.position - moving,
          moving,
          motion.rotation * contact.normal,
          probe.order_parameter - contact.order_parameter,
          motion.rotation * contact.order_parameter_gradient};
}

Sight seen_from_second(const measure::Probe& probe, const measure::SurfaceProbe& first,
                       const RigidMotion& motion) {
  const Eigen::Vector3d moving = motion.of(probe.position);
  const measure::Contact contact = first.closest(moving);
  return {probe.weight,
          contact.position - moving,
          moving,
          contact.normal,
          contact.order_parameter - probe.order_parameter,
          contact.order_parameter_gradient};
}

std::vector<Sight> look_around(const ProbeSets& probes, const measure::SurfaceProbe& first,
                               const measure::SurfaceProbe& second, const RigidMotion& motion) {
  const std::size_t num_first = probes.first.size();
  std::vector<Sight> sights(num_first + probes.second.size());
  parallel_for(static_cast<int>(sights.size()), resolved_threads(0), [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      sights[i] = i < num_first ? seen_from_first(probes.first[i], second, motion)
                                : seen_from_second(probes.second[i - num_first], first, motion);
    }
  });
  return sights;
}

Misfit misfit_of(const std::vector<Sight>& sights, double length) {
  Misfit misfit;
  double weight = 0;
  for (const Sight& sight : sights) {
    weight += sight.weight;
    misfit.shape += sight.weight * sight.gap.squaredNorm() / (length * length);
    misfit.phase += sight.weight * sight.difference * sight.difference;
  }
  return {misfit.shape / weight, misfit.phase / weight};
}

Vector6 wrench(const Eigen::Vector3d& arm, const Eigen::Vector3d& force) {
  Vector6 result;
  result << force, arm.cross(force);
  return result;
}

/// (H + damping * largest eigenvalue)^-1 g without the eigenvectors of nearly vanishing curvature.
Vector6 damped_step(const Matrix6& curvature, const Vector6& gradient, double damping) {
  constexpr double least_curvature = 1e-5;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(curvature);
  const double largest = eigen.eigenvalues()[5];
  Vector6 coefficients = eigen.eigenvectors().transpose() * gradient;
  for (int i = 0; i < 6; ++i) {
    const double value = eigen.eigenvalues()[i];
    coefficients[i] =
        value > least_curvature * largest ? coefficients[i] / (value + damping * largest) : 0;
  }
  return eigen.eigenvectors() * coefficients;
}

}  // namespace

/// shape + phase_weight * phase after a step s = (translation / R_c, rotation vector) is about
/// value - 2 gradient . s + s . curvature s.
struct RigidAlignment::Linearised {
  double value = 0;
  Vector6 gradient = Vector6::Zero();
  Matrix6 curvature = Matrix6::Zero();
};

RigidAlignment::RigidAlignment(const measure::SurfaceProbe& first,
                               const measure::SurfaceProbe& second)
    : first_(first),
      second_(second),
      length_(std::sqrt((first.area() + second.area()) / (8 * std::numbers::pi))) {}

Misfit RigidAlignment::misfit(const ProbeSets& probes, const RigidMotion& motion) const {
  return misfit_of(look_around(probes, first_, second_, motion), length_);
}

RigidAlignment::Linearised RigidAlignment::linearised(const ProbeSets& probes,
                                                      const RigidMotion& motion,
                                                      double phase_weight) const {
  const std::vector<Sight> sights = look_around(probes, first_, second_, motion);
  const Misfit misfit = misfit_of(sights, length_);
  Linearised result;
  double weight = 0;
  for (const Sight& sight : sights) {
    const Eigen::Vector3d arm = (sight.moving - first_.centroid()) / length_;
    const Vector6 along_normal = wrench(arm, sight.normal);
    const Vector6 along_gradient = wrench(arm, length_ * sight.gradient);
    weight += sight.weight;
    result.gradient += sight.weight * (wrench(arm, sight.gap / length_) -
                                       phase_weight * sight.difference * along_gradient);
    result.curvature += sight.weight * (along_normal * along_normal.transpose() +
                                        phase_weight * along_gradient * along_gradient.transpose());
  }
  result.value = misfit.shape + phase_weight * misfit.phase;
  result.gradient /= weight;
  result.curvature /= weight;
  return result;
}

RigidMotion RigidAlignment::moved(const RigidMotion& motion, const Vector6& step) const {
  const Eigen::Vector3d turn = step.tail<3>();
  const double angle = turn.norm();
  const Eigen::Matrix3d rotation = angle > 0
                                       ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                                       : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d& centre = first_.centroid();
  // rounding must not add up to a matrix that is no rotation
  const Eigen::Matrix3d turned =
      Eigen::Quaterniond(Eigen::Matrix3d(rotation * motion.rotation)).normalized().matrix();
  return {turned, rotation * (motion.translation - centre) + centre + length_ * step.head<3>()};
}

RigidMotion RigidAlignment::refined(const ProbeSets& probes, RigidMotion motion,
                                    double phase_weight, int most_steps) const {
  constexpr double largest_step = 0.5;
  constexpr double least_step = 1e-13;
  constexpr double least_gain = 1e-10;
  constexpr double largest_damping = 1e3;
  Linearised current = linearised(probes, motion, phase_weight);
  double damping = 0;
  for (int i = 0; i < most_steps; ++i) {
    Vector6 step = damped_step(current.curvature, current.gradient, damping);
    step *= std::min(1.0, largest_step / std::max(step.norm(), least_step));
    const double gain = 2 * step.dot(current.gradient) - step.dot(current.curvature * step);
    if (step.norm() < least_step || gain < least_gain * current.value) break;
    const RigidMotion trial = moved(motion, step);
    const Linearised there = linearised(probes, trial, phase_weight);
    if (there.value < current.value) {
      motion = trial;
      current = there;
      damping = damping < 1e-6 ? 0 : damping / 10;
    } else {
      damping = std::max(1e-4, 10 * damping);
      if (damping > largest_damping) break;
    }
  }
  return motion;
}

}  // namespace vesica::compare
