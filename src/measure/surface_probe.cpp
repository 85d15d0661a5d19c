#include "surface_probe.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "vesica/fem/surface_integral.hpp"

namespace vesica::measure {
namespace {

Eigen::Vector3d to_eigen(const Vec3<double>& a) { return {a.x, a.y, a.z}; }

}  // namespace

SurfaceProbe::SurfaceProbe(const problem::State& state)
    : state_(state), locator_(state.triangulation, state.values.positions) {
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const double c =
            state.is_two_phase() ? fem::scalar_at(state.values.order_parameter, sample) : 0.0;
        points_.push_back(
            {to_eigen(fem::vector_at(state.values.positions, sample)), sample.weight, c});
      });
  for (const Probe& point : points_) {
    area_ += point.weight;
    centroid_ += point.weight * point.position;
  }
  centroid_ /= area_;
  for (const Probe& point : points_) {
    const Eigen::Vector3d r = point.position - centroid_;
    variance_ += point.weight / area_ * r * r.transpose();
  }
}

std::vector<Probe> SurfaceProbe::some_points(std::size_t count) const {
  const std::size_t num_a_triangle = fem::triangle_rule().size();
  const std::size_t num_triangles = points_.size() / num_a_triangle;
  const std::size_t stride = std::max<std::size_t>(1, num_triangles / count);
  std::vector<Probe> some;
  for (std::size_t t = 0; t < num_triangles; t += stride)
    some.push_back(points_[t * num_a_triangle]);  // the rule begins with the centre
  return some;
}

Contact SurfaceProbe::closest(const Eigen::Vector3d& point) const {
  const mesh::SurfaceLocation location = locator_.closest(point);
  const auto& triangle =
      state_.triangulation->triangles()[static_cast<std::size_t>(location.triangle)];
  const fem::ShapeValues shape = fem::shape_values(location.u, location.v);
  const auto& positions = state_.values.positions;
  const auto frame =
      fem::tangent_frame(fem::to_vec3(fem::combine<3>(positions, triangle, shape.du)),
                         fem::to_vec3(fem::combine<3>(positions, triangle, shape.dv)));
  Contact contact;
  contact.position = location.point;
  contact.normal = to_eigen(frame.normal);
  if (!state_.is_two_phase()) return contact;
  const fem::SurfaceSample sample{triangle, shape, frame, 0};
  contact.order_parameter = fem::scalar_at(state_.values.order_parameter, sample);
  contact.order_parameter_gradient =
      to_eigen(fem::gradient_at(state_.values.order_parameter, sample));
  return contact;
}

double SurfaceProbe::distance(const Eigen::Vector3d& point) const {
  return locator_.closest(point).distance;
}

}  // namespace vesica::measure
