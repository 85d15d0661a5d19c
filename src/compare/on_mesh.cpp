#include "vesica/compare/on_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vesica/core/error.hpp"
#include "vesica/mesh/surface_locator.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::compare {

namespace {

constexpr int max_iterations = 30;
constexpr double negligible_move = 1e-13;  // of the radius
constexpr double farthest = 0.5;           // of the radius

/// Where the ray from `start` along `direction` meets the surface, and the location of that point.
mesh::SurfaceLocation meeting_point(const mesh::SurfaceLocator& locator,
                                    const Eigen::Vector3d& start, const Eigen::Vector3d& direction,
                                    double radius) {
  double distance = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Eigen::Vector3d point = start + distance * direction;
    const auto near = locator.closest(point, direction);
    const Eigen::Vector3d normal = locator.normal(near);
    const double cosine = normal.dot(direction);
    if (!(cosine > 0.1) || std::abs(distance) > farthest * radius) break;
    const double move = (near.point - point).dot(normal) / cosine;
    distance += move;
    if (std::abs(move) < negligible_move * radius)
      return locator.closest(start + distance * direction, direction);
  }
  throw RecoverableError(
      fmt::format("the normal at ({:.4g}, {:.4g}, {:.4g}) does not meet the other surface nearby",
                  start.x(), start.y(), start.z()));
}

}  // namespace

problem::State on_mesh_of(const problem::State& owner, const problem::State& other,
                          const RigidMotion& motion) {
  const auto& positions = owner.values.positions;
  const auto normals = problem::nodal_normals(*owner.triangulation, positions);
  const mesh::SurfaceLocator locator(other.triangulation, motion.of(other.values.positions));
  const double radius = std::sqrt(
      (positions.rowwise() - positions.colwise().mean()).rowwise().squaredNorm().maxCoeff());
  problem::State result;
  result.time = other.time;
  result.triangulation = owner.triangulation;
  result.values.positions = positions;
  result.values.mean_curvature = Eigen::VectorXd::Zero(positions.rows());
  result.values.order_parameter.resize(other.is_two_phase() ? positions.rows() : 0);
  result.values.multipliers = other.values.multipliers;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    const Eigen::Vector3d start = positions.row(i).transpose();
    const Eigen::Vector3d direction = normals.row(i).transpose();
    const auto location = meeting_point(locator, start, direction, radius);
    const double distance = (location.point - start).dot(direction);
    result.values.positions.row(i) = (start + distance * direction).transpose();
    if (other.is_two_phase()) {
      result.values.order_parameter[i] =
          locator.interpolate(location, other.values.order_parameter)[0];
    }
  }
  return result;
}

}  // namespace vesica::compare
