#include "tip_directions.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "sphere_mesh.hpp"

namespace vesica::shapes {
namespace {

/// Points on a spiral from pole to pole.
mesh::Positions spiral(int num_points) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  mesh::Positions points(num_points, 3);
  for (int i = 0; i < num_points; ++i) {
    const double z = 1 - (2.0 * i + 1) / num_points;
    const double radius = std::sqrt(1 - z * z);
    points.row(i) << radius * std::cos(golden_angle * i), radius * std::sin(golden_angle * i), z;
  }
  return points;
}

/// Moves points on the unit sphere towards the smallest energy sum 1 / distance.
mesh::Positions repel(mesh::Positions points) {
  constexpr int num_sweeps = 2000;
  const double step = 0.3 / static_cast<double>(points.rows());
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    mesh::Positions force = mesh::Positions::Zero(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      for (Eigen::Index j = 0; j < points.rows(); ++j) {
        if (i == j) continue;
        const Eigen::RowVector3d apart = points.row(i) - points.row(j);
        force.row(i) += apart / std::pow(apart.norm(), 3);
      }
    }
    points += step * force;
    points.rowwise().normalize();
  }
  return points;
}

}  // namespace

mesh::Positions tip_directions(int num_tips) {
  if (num_tips == 12) return icosahedron_vertices();
  mesh::Positions directions = mesh::Positions::Zero(num_tips, 3);
  switch (num_tips) {
    case 1:
      directions << 1, 0, 0;
      break;
    case 2:
      directions << 1, 0, 0, -1, 0, 0;
      break;
    case 3: {
      const double side = std::sqrt(0.75);
      directions << 1, 0, 0, -0.5, side, 0, -0.5, -side, 0;
      break;
    }
    case 4:
      directions << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
      break;
    case 6:
      directions << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
      break;
    default:
      return repel(spiral(num_tips));
  }
  directions.rowwise().normalize();
  return directions;
}

}  // namespace vesica::shapes
