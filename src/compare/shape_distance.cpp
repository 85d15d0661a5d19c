#include "vesica/compare/shape_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "alignment_starts.hpp"
#include "measure/surface_probe.hpp"
#include "rigid_alignment.hpp"
#include "vesica/core/error.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::compare {
namespace {

// In the coarse search phases count as much as shapes: both are of order one where the wrong
// orientation is tried. In the fine one they only choose what the shape leaves open.
constexpr double coarse_phase_weight = 0.1;
constexpr double fine_phase_weight = 1e-2;

void check_phases(const problem::State& first, const problem::State& second) {
  if (first.is_two_phase() == second.is_two_phase()) return;
  throw ConfigError(
      "shape_distance: one vesicle has a phase field and the other has none; they cannot be "
      "compared");
}

/// From the most promising starts, each improved with few probes, the best one.
RigidMotion coarse_motion(const measure::SurfaceProbe& first, const measure::SurfaceProbe& second,
                          const RigidAlignment& alignment) {
  constexpr std::size_t num_probes = 300;
  constexpr std::size_t num_candidates = 4;
  constexpr int num_steps = 15;
  constexpr double good_enough = 1e-10;
  const ProbeSets probes{first.some_points(num_probes), second.some_points(num_probes)};
  const auto rated = [&](const RigidMotion& motion) {
    const Misfit misfit = alignment.misfit(probes, motion);
    return std::pair(misfit.shape + coarse_phase_weight * misfit.phase, motion);
  };
  const auto is_better = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::vector<std::pair<double, RigidMotion>> candidates;
  for (const RigidMotion& start : alignment_starts(first, second)) {
    candidates.push_back(rated(start));
    if (candidates.back().first < good_enough) return start;
  }
  std::stable_sort(candidates.begin(), candidates.end(), is_better);
  candidates.resize(std::min(candidates.size(), num_candidates));
  for (auto& candidate : candidates) {
    candidate = rated(alignment.refined(probes, candidate.second, coarse_phase_weight, num_steps));
  }
  return std::min_element(candidates.begin(), candidates.end(), is_better)->second;
}

/// Largest distance of the points and nodes of `from`, moved by `motion`, to `to`.
template <class Motion>
double largest_distance(const measure::SurfaceProbe& from, const measure::SurfaceProbe& to,
                        const Motion& motion) {
  const auto& nodes = from.state().values.positions;
  const auto points = from.points();
  const auto num_points = static_cast<int>(points.size());
  std::vector<double> distances(points.size() + static_cast<std::size_t>(nodes.rows()));
  parallel_for(static_cast<int>(distances.size()), resolved_threads(0), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3d point = i < num_points ? points[static_cast<std::size_t>(i)].position
                                                   : Eigen::Vector3d(nodes.row(i - num_points));
      distances[static_cast<std::size_t>(i)] = to.distance(motion(point));
    }
  });
  return *std::max_element(distances.begin(), distances.end());
}

ProbeSets all_points(const measure::SurfaceProbe& first, const measure::SurfaceProbe& second) {
  return {{first.points().begin(), first.points().end()},
          {second.points().begin(), second.points().end()}};
}

ShapeDistance measured(const measure::SurfaceProbe& first, const measure::SurfaceProbe& second,
                       const RigidMotion& motion) {
  const RigidAlignment alignment(first, second);
  const Misfit misfit = alignment.misfit(all_points(first, second), motion);
  const double to_second = largest_distance(
      first, second, [&](const Eigen::Vector3d& x) { return motion.inverse_of(x); });
  const double to_first =
      largest_distance(second, first, [&](const Eigen::Vector3d& x) { return motion.of(x); });
  ShapeDistance distance;
  distance.motion = motion;
  distance.l2 = std::sqrt(misfit.shape);
  distance.hausdorff = std::max(to_first, to_second) / alignment.length();
  if (first.state().is_two_phase()) distance.phase_l2 = std::sqrt(misfit.phase);
  return distance;
}

}  // namespace

mesh::Positions RigidMotion::of(const mesh::Positions& positions) const {
  return (positions * rotation.transpose()).rowwise() + translation.transpose();
}

ShapeDistance shape_distance(const problem::State& first, const problem::State& second) {
  constexpr int most_steps = 40;
  check_phases(first, second);
  const measure::SurfaceProbe first_probe(first);
  const measure::SurfaceProbe second_probe(second);
  const RigidAlignment alignment(first_probe, second_probe);
  const ProbeSets probes = all_points(first_probe, second_probe);
  RigidMotion motion = coarse_motion(first_probe, second_probe, alignment);
  if (first.is_two_phase())
    motion = alignment.refined(probes, motion, fine_phase_weight, most_steps);
  motion = alignment.refined(probes, motion, 0, most_steps);
  return measured(first_probe, second_probe, motion);
}

ShapeDistance shape_distance(const problem::State& first, const problem::State& second,
                             const RigidMotion& motion) {
  check_phases(first, second);
  return measured(measure::SurfaceProbe(first), measure::SurfaceProbe(second), motion);
}

}  // namespace vesica::compare
