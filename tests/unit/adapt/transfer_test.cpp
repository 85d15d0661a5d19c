#include "vesica/adapt/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "nodal_shape_operators.hpp"
#include "observed_order.hpp"
#include "vesica/adapt/local_remesh.hpp"
#include "vesica/core/error.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/mesh/surface_locator.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::adapt {
namespace {

mesh::Surface shape(shapes::ShapeKind kind, int resolution) {
  shapes::ShapeOptions options;
  options.kind = kind;
  options.resolution = resolution;
  options.semi_axes << 1.5, 1, 0.8;
  return shapes::make_shape(options);
}

/// V, A and int h(c), h(c) = (3 c - c^3) / 2.
Integrals integrals_on(const mesh::Surface& surface) {
  return [triangulation = surface.triangulation](const RestorableFields& fields) {
    Eigen::Vector3d sums(mesh::enclosed_volume(*triangulation, fields.positions), 0, 0);
    for (const auto& nodes : triangulation->triangles()) {
      for (const auto& point : fem::triangle_rule()) {
        const auto frame = fem::tangent_frame(
            fem::to_vec3(fem::combine<3>(fields.positions, nodes, point.shape.du)),
            fem::to_vec3(fem::combine<3>(fields.positions, nodes, point.shape.dv)));
        const double c = fem::combine<1>(fields.order_parameter, nodes, point.shape.value)[0];
        sums[1] += point.weight * frame.area_element;
        sums[2] += point.weight * frame.area_element * 0.5 * (3 * c - c * c * c);
      }
    }
    return Eigen::VectorXd(sums);
  };
}

Eigen::VectorXd phase_on(const mesh::Positions& positions) {
  return (positions.col(0).array() / 0.4).tanh();
}

Eigen::VectorXd curvature_on(const mesh::Surface& surface) {
  const auto q = test::recovered(surface);
  return -(q.col(0) + q.col(1) + q.col(2));
}

Eigen::VectorXd derivative_of_phase(const Eigen::VectorXd& c) {
  return 1.5 * (1 - c.array().square());
}

/// The variations of V and A along the normals, and of int h(c) in c.
std::vector<NodalChange> changes_of(const Eigen::VectorXd& curvature,
                                    const Eigen::VectorXd& phase_derivative) {
  std::vector<NodalChange> changes{{Eigen::VectorXd::Ones(curvature.size()), {}}, {curvature, {}}};
  if (phase_derivative.size() > 0) changes.push_back({{}, phase_derivative});
  return changes;
}

TEST(Transfer, OfASmoothFieldHasThirdOrder) {
  const auto error = [](int resolution) {
    const mesh::Surface old = shape(shapes::ShapeKind::ellipsoid, resolution);
    const Eigen::VectorXd sizes = Eigen::VectorXd::Constant(old.positions.rows(), 0.8 / resolution);
    const Remeshed found = local_remesh(old, sizes);
    const Eigen::VectorXd carried =
        mesh::interpolate(*old.triangulation, found.origins, phase_on(old.positions));
    return (carried - phase_on(found.surface.positions)).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(test::observed_order(error(6), error(12), 2), 2.6);
}

TEST(RestoreIntegrals, PutsVolumeAreaAndPhaseBackAfterRemeshing) {
  const mesh::Surface old = shape(shapes::ShapeKind::ellipsoid, 6);
  const Eigen::VectorXd c = phase_on(old.positions);
  const Eigen::VectorXd targets = integrals_on(old)({old.positions, c});
  const Remeshed found = local_remesh(old, Eigen::VectorXd::Constant(old.positions.rows(), 0.25));
  const Eigen::VectorXd carried = mesh::interpolate(*old.triangulation, found.origins, c);
  const Eigen::VectorXd curvature =
      mesh::interpolate(*old.triangulation, found.origins, curvature_on(old));
  const RestorableFields start{found.surface.positions, carried};
  const Integrals integrals = integrals_on(found.surface);
  const Eigen::VectorXd before = integrals(start) - targets;
  ASSERT_GT(before.cwiseAbs().minCoeff(), 1e-6);
  const Restored restored = restore_integrals(
      integrals, targets,
      restoring_directions(found.surface, changes_of(curvature, derivative_of_phase(carried))),
      start);
  EXPECT_TRUE(restored.converged);
  EXPECT_LE(restored.num_steps, 4);
  EXPECT_LT(restored.error.cwiseAbs().maxCoeff(), 1e-10);
  // The change is as small as the error it mends.
  EXPECT_LT((restored.fields.positions - start.positions).cwiseAbs().maxCoeff(),
            10 * before.cwiseAbs().maxCoeff());
}

TEST(RestoreIntegrals, MendsErrorsOfOnePercent) {
  const mesh::Surface surface = shape(shapes::ShapeKind::ellipsoid, 4);
  const RestorableFields start{surface.positions, phase_on(surface.positions)};
  const Integrals integrals = integrals_on(surface);
  Eigen::VectorXd targets = integrals(start);
  targets[0] *= 1.01;
  targets[1] *= 1.02;
  targets[2] += 0.05;
  const auto restored = restore_integrals(
      integrals, targets,
      restoring_directions(
          surface, changes_of(curvature_on(surface), derivative_of_phase(start.order_parameter))),
      start);
  EXPECT_TRUE(restored.converged);
  EXPECT_LT((integrals(restored.fields) - targets).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(RestoreIntegrals, LeavesFieldsThatAreRightAlone) {
  const mesh::Surface surface = shape(shapes::ShapeKind::ellipsoid, 3);
  const RestorableFields start{surface.positions, phase_on(surface.positions)};
  const Integrals integrals = integrals_on(surface);
  const auto restored = restore_integrals(
      integrals, integrals(start),
      restoring_directions(surface, changes_of(curvature_on(surface), {})), start);
  EXPECT_TRUE(restored.converged);
  EXPECT_EQ(restored.num_steps, 0);
  EXPECT_EQ(restored.fields.positions, start.positions);
}

TEST(RestoreIntegrals, SaysWhenASphereCannotHaveMoreVolumeAtItsArea) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 4);
  const RestorableFields start{sphere.positions, Eigen::VectorXd::Ones(sphere.positions.rows())};
  const Integrals integrals = integrals_on(sphere);
  Eigen::VectorXd targets = integrals(start);
  targets[0] *= 1.05;
  const auto restored =
      restore_integrals(integrals, targets,
                        restoring_directions(sphere, changes_of(curvature_on(sphere), {})), start);
  EXPECT_FALSE(restored.converged);
  EXPECT_TRUE(restored.fields.positions.allFinite());
  EXPECT_LT((restored.fields.positions - start.positions).cwiseAbs().maxCoeff(), 0.1);
}

TEST(RestoringDirections, AreNormalToTheSurface) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 6);
  const Eigen::VectorXd curvature = Eigen::VectorXd::Constant(sphere.positions.rows(), -2);
  const auto directions = restoring_directions(sphere, changes_of(curvature, {}));
  ASSERT_EQ(directions.size(), 2U);
  EXPECT_LT((directions[0].positions - sphere.positions).cwiseAbs().maxCoeff(), 5e-3);
  EXPECT_LT((directions[1].positions + 2 * sphere.positions).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(RestoreIntegrals, RefusesTargetsOfAnotherNumber) {
  const mesh::Surface surface = shape(shapes::ShapeKind::sphere, 1);
  const RestorableFields start{surface.positions, Eigen::VectorXd::Zero(42)};
  EXPECT_THROW((void)restore_integrals(integrals_on(surface), Eigen::VectorXd::Zero(2), {}, start),
               ConfigError);
}

}  // namespace
}  // namespace vesica::adapt
