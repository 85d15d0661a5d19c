#include "vesica/measure/profile.hpp"

#include <Eigen/Geometry>

#include "cross_sections.hpp"
#include "long_axis.hpp"
#include "surface_probe.hpp"
#include "vesica/linalg/dense.hpp"

namespace vesica::measure {
namespace {

ProfilePoint in_plane(const SectionPoint& point, const ProfilePlane& plane) {
  const Eigen::Vector3d x = point.position - plane.origin;
  return {x.dot(plane.along), x.dot(plane.across), point.order_parameter};
}

/// Where the order parameter, linear from `a` to `b`, vanishes.
ProfilePoint interface_between(const ProfilePoint& a, const ProfilePoint& b) {
  const double t = a.order_parameter / (a.order_parameter - b.order_parameter);
  return {a.along + t * (b.along - a.along), a.across + t * (b.across - a.across), 0};
}

}  // namespace

ProfilePlane profile_plane(const problem::State& state) {
  const SurfaceProbe probe(state);
  ProfilePlane plane;
  plane.origin = probe.centroid();
  plane.along = long_axis(state).direction;
  const Eigen::Matrix3d projection =
      Eigen::Matrix3d::Identity() - plane.along * plane.along.transpose();
  const auto eigen = linalg::symmetric_eigensystem(projection * probe.variance() * projection);
  plane.across = eigen.vectors.col(2);
  return plane;
}

std::vector<ProfileLoop> profile(const problem::State& state, const ProfilePlane& plane) {
  const Eigen::Vector3d normal = plane.along.cross(plane.across);
  const CrossSections sections(state, normal);
  std::vector<ProfileLoop> loops;
  for (const SectionLoop& section : sections.loops_at(normal.dot(plane.origin))) {
    ProfileLoop& loop = loops.emplace_back();
    for (const SectionPoint& corner : section) {
      const ProfilePoint point = in_plane(corner, plane);
      if (!loop.empty() && loop.back().order_parameter * point.order_parameter < 0)
        loop.push_back(interface_between(loop.back(), point));
      loop.push_back(point);
    }
  }
  return loops;
}

}  // namespace vesica::measure
