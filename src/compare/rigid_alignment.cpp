#include "rigid_alignment.hpp"

#include <ceres/tiny_solver.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "vesica/core/parallel.hpp"

namespace vesica::compare {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double least_distance = 1e-13;  // of the length

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

/// `motion` and then a step (translation / length, Gibbs' vector) about `centre`.
RigidMotion moved(const RigidMotion& motion, const Vector6& step, const Eigen::Vector3d& centre,
                  double length) {
  const Eigen::Vector3d half = step.tail<3>() / 2;
  const Eigen::Quaterniond turn(1, half.x(), half.y(), half.z());
  const Eigen::Matrix3d rotation = turn.normalized().toRotationMatrix();
  // rounding must not add up to a matrix that is no rotation
  const Eigen::Quaterniond turned(Eigen::Matrix3d(rotation * motion.rotation));
  return {turned.normalized().toRotationMatrix(),
          rotation * (motion.translation - centre) + centre + length * step.head<3>()};
}

}  // namespace

/// What ceres::TinySolver makes small: the roots of the parts of a misfit, at a step after `start`.
struct RigidAlignment::Residuals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 6 };

  const RigidAlignment& alignment;
  const ProbeSets& probes;
  const RigidMotion& start;
  double phase_weight;

  [[nodiscard]] int NumResiduals() const {
    return static_cast<int>(2 * (probes.first.size() + probes.second.size()));
  }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Vector6 step = Eigen::Map<const Vector6>(parameters);
    const double length = alignment.length_;
    const Eigen::Vector3d& centre = alignment.first_.centroid();
    const Eigen::Vector3d pivot = centre + length * step.head<3>();
    const Eigen::Vector3d gibbs = step.tail<3>();
    const auto row_of = [&](const Sight& sight, const Eigen::Vector3d& force) {
      const Eigen::Vector3d torque = (sight.moving - pivot).cross(force) / length;
      Vector6 row;
      row << force, (torque + torque.cross(gibbs) / 2) / (1 + gibbs.squaredNorm() / 4);
      return row;
    };
    const auto sights = look_around(probes, alignment.first_, alignment.second_,
                                    moved(start, step, centre, length));
    double weight = 0;
    for (const Sight& sight : sights) weight += sight.weight;
    Eigen::Map<Eigen::MatrixXd> slopes(jacobian, jacobian ? NumResiduals() : 0, 6);
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Sight& sight = sights[i];
      const double shape = std::sqrt(sight.weight / weight);
      const double phase = std::sqrt(phase_weight) * shape;
      const double gap = sight.gap.norm();
      residuals[2 * i] = shape * gap / length;
      residuals[2 * i + 1] = phase * sight.difference;
      if (jacobian == nullptr) continue;
      const auto k = static_cast<Eigen::Index>(2 * i);
      const Eigen::Vector3d along =
          gap > least_distance * length ? Eigen::Vector3d(sight.gap / gap) : sight.normal;
      slopes.row(k) = -shape * row_of(sight, along);
      slopes.row(k + 1) = phase * row_of(sight, length * sight.gradient);
    }
    return true;
  }
};

RigidAlignment::RigidAlignment(const measure::SurfaceProbe& first,
                               const measure::SurfaceProbe& second)
    : first_(first),
      second_(second),
      length_(std::sqrt((first.area() + second.area()) / (8 * std::numbers::pi))) {}

Misfit RigidAlignment::misfit(const ProbeSets& probes, const RigidMotion& motion) const {
  return misfit_of(look_around(probes, first_, second_, motion), length_);
}

RigidMotion RigidAlignment::refined(const ProbeSets& probes, const RigidMotion& motion,
                                    double phase_weight, int most_steps) const {
  constexpr double least_gain = 1e-10;
  const Misfit start = misfit(probes, motion);
  ceres::TinySolver<Residuals> solver;
  solver.options.max_num_iterations = most_steps;
  solver.options.gradient_tolerance = 0;
  solver.options.cost_threshold = 0;
  solver.options.parameter_tolerance = 1e-13;
  solver.options.function_tolerance =
      least_distance * least_distance + least_gain * (start.shape + phase_weight * start.phase);
  Vector6 step = Vector6::Zero();
  solver.Solve({*this, probes, motion, phase_weight}, &step);
  return moved(motion, step, first_.centroid(), length_);
}

}  // namespace vesica::compare
