#include "vesica/adapt/transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vesica/core/error.hpp"
#include "vesica/fem/quadratic_triangle.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/linalg/dense.hpp"
#include "vesica/mesh/local_nodes.hpp"

namespace vesica::adapt {
namespace {

constexpr int max_steps = 8;
/// Relative to the extent of the surface: steps of differences, and Newton steps that count as
/// none.
constexpr double difference = 1e-5;
constexpr double negligible = 1e-13;
/// Errors that count as none, relative to the change of an integral when a field moves by its
/// extent.
constexpr double small_error = 1e-12;
/// Ratio of pivots below which directions count as parallel.
constexpr double parallel = 1e-6;

mesh::Positions nodal_normals(const mesh::Surface& surface) {
  mesh::Positions normals = mesh::Positions::Zero(surface.positions.rows(), 3);
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    for (std::size_t i = 0; i < 6; ++i) {
      const auto shape =
          fem::shape_values(mesh::node_parameters[i][0], mesh::node_parameters[i][1]);
      const auto frame =
          fem::tangent_frame(fem::to_vec3(fem::combine<3>(surface.positions, nodes, shape.du)),
                             fem::to_vec3(fem::combine<3>(surface.positions, nodes, shape.dv)));
      normals.row(nodes[i]) += Eigen::RowVector3d(frame.normal.x, frame.normal.y, frame.normal.z);
    }
  }
  normals.rowwise().normalize();
  return normals;
}

RestorableFields moved(const RestorableFields& start, const RestorableFields& direction,
                       double step) {
  RestorableFields fields = start;
  if (direction.positions.rows() > 0) fields.positions += step * direction.positions;
  if (direction.order_parameter.size() > 0)
    fields.order_parameter += step * direction.order_parameter;
  return fields;
}

template <class Field>
double largest(const Field& field) {
  return field.size() > 0 ? field.cwiseAbs().maxCoeff() : 0.0;
}

/// Coefficient with which a direction moves a node by the extent of the surface, or c by one.
double full_step(const RestorableFields& direction, double extent) {
  const double rate =
      std::max(largest(direction.positions) / extent, largest(direction.order_parameter));
  return rate > 0 ? 1 / rate : 0;
}

/// Derivatives of the integrals with respect to the directions, each in units of its full step.
Eigen::MatrixXd derivatives(const Integrals& integrals, const RestorableFields& at,
                            const std::vector<RestorableFields>& directions,
                            const Eigen::VectorXd& full_steps, Eigen::Index num_integrals) {
  Eigen::MatrixXd result(num_integrals, full_steps.size());
  for (Eigen::Index k = 0; k < full_steps.size(); ++k) {
    const RestorableFields& direction = directions[static_cast<std::size_t>(k)];
    const double step = difference * full_steps[k];
    result.col(k) =
        (integrals(moved(at, direction, step)) - integrals(moved(at, direction, -step))) /
        (2 * difference);
  }
  return result;
}

}  // namespace

std::vector<RestorableFields> restoring_directions(const mesh::Surface& surface,
                                                   const std::vector<NodalChange>& changes) {
  const mesh::Positions normals = nodal_normals(surface);
  std::vector<RestorableFields> directions;
  for (const NodalChange& change : changes) {
    mesh::Positions move;
    if (change.normal.size() > 0) move = change.normal.asDiagonal() * normals;
    directions.push_back({std::move(move), change.order_parameter});
  }
  return directions;
}

Restored restore_integrals(const Integrals& integrals, const Eigen::VectorXd& targets,
                           const std::vector<RestorableFields>& directions,
                           const RestorableFields& start) {
  Restored result{start, integrals(start), 0, false};
  if (result.error.size() != targets.size()) {
    throw ConfigError(
        fmt::format("restoring integrals: {} targets: must be one for each of the {} "
                    "integrals",
                    targets.size(), result.error.size()));
  }
  result.error -= targets;
  const Eigen::RowVector3d centre = start.positions.colwise().mean();
  const double extent = largest(start.positions.rowwise() - centre);
  Eigen::VectorXd full_steps(static_cast<Eigen::Index>(directions.size()));
  for (Eigen::Index k = 0; k < full_steps.size(); ++k) {
    full_steps[k] = full_step(directions[static_cast<std::size_t>(k)], extent);
  }
  while (result.num_steps < max_steps) {
    const Eigen::MatrixXd jacobian =
        derivatives(integrals, result.fields, directions, full_steps, targets.size());
    const Eigen::VectorXd scales = jacobian.rowwise().lpNorm<Eigen::Infinity>();
    result.converged = (result.error.array().abs() <= small_error * scales.array()).all();
    if (!jacobian.allFinite()) break;
    const Eigen::VectorXd step = -linalg::singular_system(jacobian).solve(result.error, parallel);
    if (result.converged || !step.allFinite() || largest(step) < negligible) break;
    for (Eigen::Index k = 0; k < step.size(); ++k) {
      result.fields =
          moved(result.fields, directions[static_cast<std::size_t>(k)], step[k] * full_steps[k]);
    }
    result.error = integrals(result.fields) - targets;
    ++result.num_steps;
  }
  return result;
}

}  // namespace vesica::adapt
