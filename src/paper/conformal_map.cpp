#include "vesica/paper/conformal_map.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "conformal_newton.hpp"
#include "vertex_stiffness.hpp"
#include "vesica/core/error.hpp"
#include "vesica/linalg/sparse_cholesky.hpp"

namespace vesica::paper {
namespace {

constexpr int max_flow_steps = 200;
constexpr double flow_step = 0.2;      // at area 4 pi
constexpr double round_enough = 2e-3;  // relative deviation of |x|
constexpr int max_centring_steps = 50;
constexpr double centred = 1e-10;

/// Moves the centre of the surface to 0 and scales its area to 4 pi.
void normalise(const VertexNumbers& numbers, mesh::Positions& x) {
  const Eigen::VectorXd areas = vertex_areas(numbers, x);
  const Eigen::RowVector3d centre = areas.transpose() * x / areas.sum();
  x.rowwise() -= centre;
  x *= std::sqrt(4 * std::numbers::pi / areas.sum());
}

bool is_round(const mesh::Positions& x) {
  const Eigen::ArrayXd radii = x.rowwise().norm();
  return std::sqrt((radii - radii.mean()).square().mean()) < round_enough * radii.mean();
}

/// Conformalised mean curvature flow, implicit steps (M + tau A_0) x' = M x, M lumped, until the
/// surface is a sphere (Kazhdan, Solomon, Ben-Chen: Can mean-curvature flow be modified to be
/// non-singular?, 2012).
mesh::Positions flow_to_sphere(const VertexNumbers& numbers, const Sparse& stiffness,
                               mesh::Positions x) {
  normalise(numbers, x);
  linalg::SparseCholesky cholesky(to_linalg(stiffness));
  for (int step = 0; step < max_flow_steps && !is_round(x); ++step) {
    const Eigen::VectorXd areas = vertex_areas(numbers, x);
    Sparse matrix = flow_step * stiffness;
    matrix.diagonal() += areas;
    cholesky.factorise(to_linalg(matrix));
    for (int k = 0; k < 3; ++k) x.col(k) = cholesky.solve(areas.cwiseProduct(x.col(k)));
    normalise(numbers, x);
  }
  return x.rowwise().normalized();
}

/// Conformal transformations of the sphere that take the mean of u, weighted with the areas on the
/// surface, to 0 (Baden, Crane, Kazhdan: Moebius registration, 2018).
void centre(const Eigen::VectorXd& areas, mesh::Positions& u) {
  for (int step = 0; step < max_centring_steps; ++step) {
    const Eigen::Vector3d mean = u.transpose() * areas / areas.sum();
    if (mean.norm() < centred) return;
    const Eigen::Matrix3d moments = u.transpose() * areas.asDiagonal() * u / areas.sum();
    const Eigen::Matrix3d jacobian = 2 * (Eigen::Matrix3d::Identity() - moments);
    Eigen::Vector3d c = -jacobian.ldlt().solve(mean);
    if (c.norm() > 0.5) c *= 0.5 / c.norm();
    for (auto row : u.rowwise()) {
      const Eigen::Vector3d shifted = row.transpose() + c;
      row = ((1 - c.squaredNorm()) / shifted.squaredNorm() * shifted + c).normalized().transpose();
    }
  }
}

int count_flipped(const VertexNumbers& numbers, const mesh::Positions& u) {
  int count = 0;
  for (const auto& [a, b, c] : numbers.triangles) {
    const Eigen::Vector3d x = u.row(a);
    count += x.dot(Eigen::Vector3d(u.row(b)).cross(Eigen::Vector3d(u.row(c)))) <= 0 ? 1 : 0;
  }
  return count;
}

mesh::Positions with_middles(const mesh::Triangulation& triangulation, const VertexNumbers& numbers,
                             const mesh::Positions& u) {
  mesh::Positions images(triangulation.num_nodes(), 3);
  for (Eigen::Index i = 0; i < u.rows(); ++i)
    images.row(numbers.node_of_vertex[static_cast<std::size_t>(i)]) = u.row(i);
  for (const mesh::QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t side = 0; side < 3; ++side) {
      images.row(nodes[3 + side]) =
          0.5 * (images.row(nodes[side]) + images.row(nodes[(side + 1) % 3]));
    }
  }
  return images;
}

}  // namespace

void check_genus_zero(const mesh::Triangulation& triangulation) {
  const int components = triangulation.num_components();
  if (components != 1) {
    throw ConfigError(
        fmt::format("conformal map: the surface has {} components: must be one", components));
  }
  const int genus = triangulation.genus();
  if (genus != 0)
    throw ConfigError(fmt::format("conformal map: the surface has genus {}: must be 0", genus));
}

ConformalMap conformal_map(const mesh::Surface& surface) {
  check_genus_zero(*surface.triangulation);
  const VertexNumbers numbers = vertex_numbers(*surface.triangulation);
  mesh::Positions x(static_cast<Eigen::Index>(numbers.node_of_vertex.size()), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    x.row(i) = surface.positions.row(numbers.node_of_vertex[static_cast<std::size_t>(i)]);
  const Sparse matrix = stiffness(numbers, x);
  const Eigen::VectorXd areas = vertex_areas(numbers, x);
  mesh::Positions guess = flow_to_sphere(numbers, matrix, x);
  centre(areas, guess);
  const ConformalSolution solution = solve_conformal(numbers, matrix, areas, guess);
  ConformalMap map;
  map.images = with_middles(*surface.triangulation, numbers, solution.images);
  map.energy = 0.5 * solution.images.cwiseProduct(matrix * solution.images).sum();
  map.residual = solution.residual;
  map.num_steps = solution.num_steps;
  map.converged = solution.converged;
  map.num_flipped = count_flipped(numbers, solution.images);
  return map;
}

}  // namespace vesica::paper
