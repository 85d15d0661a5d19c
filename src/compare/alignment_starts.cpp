#include "alignment_starts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "vesica/linalg/dense.hpp"

namespace vesica::compare {
namespace {

bool have_same_connectivity(const problem::State& first, const problem::State& second) {
  if (first.triangulation == second.triangulation) return true;
  const auto a = first.triangulation->triangles();
  const auto b = second.triangulation->triangles();
  return first.triangulation->num_nodes() == second.triangulation->num_nodes() &&
         std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Least squares over the nodes (Kabsch 1976).
RigidMotion node_onto_node(const mesh::Positions& first, const mesh::Positions& second) {
  const Eigen::RowVector3d first_mean = first.colwise().mean();
  const Eigen::RowVector3d second_mean = second.colwise().mean();
  const Eigen::Matrix3d covariance =
      (first.rowwise() - first_mean).transpose() * (second.rowwise() - second_mean);
  const auto system = linalg::singular_system(covariance);
  const Eigen::Matrix3d left = system.left;
  const Eigen::Matrix3d right = system.right;
  const double sign = (left * right.transpose()).determinant() < 0 ? -1 : 1;
  RigidMotion motion;
  motion.rotation = left * Eigen::Vector3d(1, 1, sign).asDiagonal() * right.transpose();
  motion.translation = first_mean.transpose() - motion.rotation * second_mean.transpose();
  return motion;
}

/// Axes as columns, right-handed, by ascending variance.
struct PrincipalAxes {
  Eigen::Matrix3d axes;
  Eigen::Vector3d variances;

  explicit PrincipalAxes(const Eigen::Matrix3d& variance) {
    const auto eigen = linalg::symmetric_eigensystem(variance);
    axes = eigen.vectors;
    variances = eigen.values;
    if (axes.determinant() < 0) axes.col(0) *= -1;
  }
  [[nodiscard]] bool are_alike(int a, int b) const {
    return variances[b] - variances[a] < 0.05 * variances[b];
  }
};

Eigen::Matrix3d turn(double eighths, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(eighths * std::numbers::pi / 4, axis).toRotationMatrix();
}

/// Rotations in the frame of the axes of inertia that keep every axis within its group of alike
/// ones.
std::vector<Eigen::Matrix3d> orientations(const PrincipalAxes& principal) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const bool low_pair = principal.are_alike(0, 1);
  const bool high_pair = principal.are_alike(1, 2);
  std::vector<Eigen::Matrix3d> result;
  if (low_pair && high_pair) {  // the faces of a cube, and quarter turns of each
    for (const auto& face :
         {turn(0, x), turn(2, x), turn(4, x), turn(6, x), turn(2, y), turn(6, y)})
      for (int k = 0; k < 8; k += 2) result.push_back(face * turn(k, z));
    return result;
  }
  const Eigen::Vector3d& axis = low_pair ? z : x;
  const int step = low_pair || high_pair ? 1 : 4;
  for (int k = 0; k < 8; k += step)
    for (const auto& flip : {turn(0, y), turn(4, y)}) result.push_back(turn(k, axis) * flip);
  return result;
}

}  // namespace

std::vector<RigidMotion> alignment_starts(const measure::SurfaceProbe& first,
                                          const measure::SurfaceProbe& second) {
  std::vector<RigidMotion> starts;
  if (have_same_connectivity(first.state(), second.state())) {
    starts.push_back(
        node_onto_node(first.state().values.positions, second.state().values.positions));
  }
  starts.emplace_back();
  const PrincipalAxes from(second.variance());
  const PrincipalAxes to(first.variance());
  for (const Eigen::Matrix3d& orientation : orientations(to)) {
    RigidMotion motion;
    motion.rotation = to.axes * orientation * from.axes.transpose();
    motion.translation = first.centroid() - motion.rotation * second.centroid();
    starts.push_back(motion);
  }
  return starts;
}

}  // namespace vesica::compare
