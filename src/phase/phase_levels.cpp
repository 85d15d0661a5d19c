#include "phase_levels.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/refuse.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::phase {
namespace {

Eigen::Vector3d centroid(const mesh::Surface& surface) {
  problem::State state;
  state.triangulation = surface.triangulation;
  state.values.positions = surface.positions;
  Vec3<double> moment;
  double area = 0;
  fem::for_each_point(*state.triangulation, state.values.positions,
                      [&](const fem::SurfaceSample& sample) {
                        moment = moment + sample.weight * fem::vector_at(surface.positions, sample);
                        area += sample.weight;
                      });
  return Eigen::Vector3d(moment.x, moment.y, moment.z) / area;
}

Eigen::VectorXd coordinate(const PhaseOptions& options, const mesh::Surface& surface) {
  if (options.axis == Axis::radial) {
    const Eigen::RowVector2d centre = centroid(surface).head<2>();
    return (surface.positions.leftCols<2>().rowwise() - centre).rowwise().norm();
  }
  return surface.positions.col(static_cast<Eigen::Index>(options.axis));
}

PhaseLevels ramp_levels(const PhaseOptions& options, const mesh::Surface& surface) {
  if (options.from == options.to) {
    refuse("phase.to", options.to, fmt::format("must differ from phase.from = {}", options.from));
  }
  const Eigen::ArrayXd x = coordinate(options, surface).array();
  return {(2 * x - options.from - options.to) / (options.to - options.from), PhaseProfile::clip};
}

PhaseLevels cap_levels(const PhaseOptions& options, const mesh::Surface& surface, double width) {
  const Eigen::ArrayXd x = coordinate(options, surface).array();
  const double caps = options.ends == CapEnds::both ? 2 : 1;
  const double height = options.fraction * (x.maxCoeff() - x.minCoeff()) / caps;
  const Eigen::ArrayXd high = x - (x.maxCoeff() - height);
  const Eigen::ArrayXd low = x.minCoeff() + height - x;
  switch (options.ends) {
    case CapEnds::high:
      return {high / width, PhaseProfile::tanh};
    case CapEnds::low:
      return {low / width, PhaseProfile::tanh};
    case CapEnds::both:
      break;
  }
  return {high.max(low) / width, PhaseProfile::tanh};
}

/// Distance in periods to the interface of the band around the middle of each period, positive
/// inside.
double band_level(double periods, double fraction) {
  return 0.5 * fraction - std::abs(periods - std::floor(periods) - 0.5);
}

PhaseLevels bands_along(const PhaseOptions& options, const mesh::Surface& surface, double width) {
  const Eigen::ArrayXd x = coordinate(options, surface).array();
  const double period = (x.maxCoeff() - x.minCoeff()) / options.count;
  Eigen::VectorXd levels(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    levels[i] = band_level((x[i] - x.minCoeff()) / period, options.fraction) * period / width;
  }
  return {std::move(levels), PhaseProfile::tanh};
}

/// Distances along the circles around the axis: radius times angle, so that there is no seam.
PhaseLevels bands_around(const PhaseOptions& options, const mesh::Surface& surface, double width) {
  if (options.axis == Axis::radial)
    throw ConfigError("phase.axis = \"radial\": bands around an axis need x, y or z");
  const auto axis = static_cast<Eigen::Index>(options.axis);
  const Eigen::Index first = (axis + 1) % 3;
  const Eigen::Index second = (axis + 2) % 3;
  const Eigen::Vector3d centre = centroid(surface);
  const double period = 2 * std::numbers::pi / options.count;
  Eigen::VectorXd levels(surface.positions.rows());
  for (Eigen::Index i = 0; i < levels.size(); ++i) {
    const double a = surface.positions(i, first) - centre[first];
    const double b = surface.positions(i, second) - centre[second];
    const double level = band_level(std::atan2(b, a) / period, options.fraction);
    levels[i] = level * period * std::hypot(a, b) / width;
  }
  return {std::move(levels), PhaseProfile::tanh};
}

void check_spots(const PhaseOptions& options) {
  if (options.directions.empty())
    refuse("phase.directions", "[]", "must name at least one direction");
  for (std::size_t k = 0; k < options.directions.size(); ++k) {
    const auto& d = options.directions[k];
    if (d.squaredNorm() > 0) continue;
    refuse(fmt::format("phase.directions[{}]", k), fmt::format("[{}, {}, {}]", d.x(), d.y(), d.z()),
           "must be finite and not zero");
  }
  if (options.angle >= 180) refuse("phase.angle", options.angle, "must be < 180");
}

/// Distances on the sphere around the centroid through the point: radius times angle.
PhaseLevels spot_levels(const PhaseOptions& options, const mesh::Surface& surface, double width) {
  check_spots(options);
  const Eigen::Vector3d centre = centroid(surface);
  const double opening = options.angle * std::numbers::pi / 180;
  Eigen::VectorXd levels(surface.positions.rows());
  for (Eigen::Index i = 0; i < levels.size(); ++i) {
    const Eigen::Vector3d x = surface.positions.row(i).transpose() - centre;
    double smallest = std::numbers::pi;
    for (const auto& direction : options.directions) {
      smallest = std::min(smallest, std::atan2(x.cross(direction).norm(), x.dot(direction)));
    }
    levels[i] = (opening - smallest) * x.norm() / width;
  }
  return {std::move(levels), PhaseProfile::tanh};
}

PhaseLevels uniform_levels(const PhaseOptions& options, Eigen::Index num_nodes) {
  if (std::abs(options.mean) > 1) refuse("phase.mean", options.mean, "must be between -1 and 1");
  return {Eigen::VectorXd::Constant(num_nodes, options.mean), PhaseProfile::clip};
}

/// The generator is fixed by the standard and its numbers are scaled here, so that a seed means the
/// same everywhere.
PhaseLevels noise_levels(const PhaseOptions& options, Eigen::Index num_nodes) {
  auto levels = uniform_levels(options, num_nodes);
  std::mt19937_64 generator(static_cast<std::uint64_t>(options.seed));
  for (auto& level : levels.values) {
    const double random = static_cast<double>(generator() >> 11) * 0x1p-53;  // in [0, 1)
    level += options.amplitude * (2 * random - 1);
  }
  return levels;
}

}  // namespace

PhaseLevels phase_levels(const PhaseOptions& options, const mesh::Surface& surface,
                         double interface_width) {
  switch (options.kind) {
    case PhaseKind::ramp:
      return ramp_levels(options, surface);
    case PhaseKind::caps:
      return cap_levels(options, surface, interface_width);
    case PhaseKind::bands:
      if (options.direction == BandDirection::along) {
        return bands_along(options, surface, interface_width);
      }
      return bands_around(options, surface, interface_width);
    case PhaseKind::spots:
      return spot_levels(options, surface, interface_width);
    case PhaseKind::noise:
      return noise_levels(options, surface.positions.rows());
    case PhaseKind::uniform:
    case PhaseKind::file:
      break;
  }
  return uniform_levels(options, surface.positions.rows());
}

}  // namespace vesica::phase
