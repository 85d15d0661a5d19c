#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "observed_order.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/paper/conformal_map.hpp"
#include "vesica/paper/conformal_remesh.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::paper {
namespace {

using Eigen::Vector3d;

constexpr double sphere_area = 4 * std::numbers::pi;

mesh::Surface shape(shapes::ShapeKind kind, int resolution) {
  shapes::ShapeOptions options;
  options.kind = kind;
  options.resolution = resolution;
  options.semi_axes << 1.5, 1, 0.8;
  return shapes::make_shape(options);
}

/// Root mean square, over all angles of the flat triangles, of what the map changes them by [rad].
double angle_defect(const mesh::Surface& surface, const ConformalMap& map) {
  const auto angle = [](const mesh::Positions& x, const auto& nodes, std::size_t i) {
    const Vector3d a = x.row(nodes[(i + 1) % 3]) - x.row(nodes[i]);
    const Vector3d b = x.row(nodes[(i + 2) % 3]) - x.row(nodes[i]);
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  double sum = 0;
  for (const auto& nodes : surface.triangulation->triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double change = angle(map.images, nodes, i) - angle(surface.positions, nodes, i);
      sum += change * change;
    }
  }
  return std::sqrt(sum / (3.0 * surface.triangulation->num_triangles()));
}

TEST(ConformalMap, OfASphereIsARotation) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 4);
  const ConformalMap map = conformal_map(sphere);
  EXPECT_TRUE(map.converged);
  // A rotation keeps all scalar products of corners.
  for (const auto& nodes : sphere.triangulation->triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = nodes[i];
      const auto b = sphere.triangulation->triangles().front()[i];
      EXPECT_NEAR(map.images.row(a).dot(map.images.row(b)),
                  sphere.positions.row(a).dot(sphere.positions.row(b)), 1e-3);
    }
  }
}

class ConformalMapOfShapes : public ::testing::TestWithParam<shapes::ShapeKind> {};

TEST_P(ConformalMapOfShapes, CoversTheSphereOnceWithLeastEnergy) {
  const ConformalMap coarse = conformal_map(shape(GetParam(), 4));
  const ConformalMap fine = conformal_map(shape(GetParam(), 8));
  for (const auto& map : {coarse, fine}) {
    EXPECT_TRUE(map.converged);
    EXPECT_LT(map.residual, 1e-10);
    EXPECT_LT(map.num_steps, 10);
    EXPECT_EQ(map.num_flipped, 0);
  }
  // The image is an inscribed polyhedron, its area below 4 pi by O(h^2), and the energy above it.
  EXPECT_GT(test::observed_order(coarse.energy - sphere_area, fine.energy - sphere_area, 2), 1.7);
  EXPECT_NEAR(fine.energy, sphere_area, 0.02 * sphere_area);
}

TEST_P(ConformalMapOfShapes, HasEnergyAboveTheAreaOfItsImage) {
  const mesh::Surface surface = shape(GetParam(), 5);
  const ConformalMap map = conformal_map(surface);
  double area = 0;
  for (const double part : mesh::element_areas(*surface.triangulation, map.images)) area += part;
  EXPECT_GT(map.energy, area);
  EXPECT_LT(map.energy, 1.02 * area);
}

TEST_P(ConformalMapOfShapes, KeepsAnglesBetterOnAFinerMesh) {
  const mesh::Surface coarse = shape(GetParam(), 4);
  const mesh::Surface fine = shape(GetParam(), 8);
  const double defect = angle_defect(fine, conformal_map(fine));
  EXPECT_GT(test::observed_order(angle_defect(coarse, conformal_map(coarse)), defect, 2), 0.8);
  EXPECT_LT(defect, 0.1);
}

TEST_P(ConformalMapOfShapes, HasItsAreaCentredOnTheSphere) {
  const mesh::Surface surface = shape(GetParam(), 4);
  const ConformalMap map = conformal_map(surface);
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const auto& nodes : surface.triangulation->triangles()) {
    const Vector3d a = surface.positions.row(nodes[1]) - surface.positions.row(nodes[0]);
    const Vector3d b = surface.positions.row(nodes[2]) - surface.positions.row(nodes[0]);
    const double part = 0.5 * a.cross(b).norm();
    area += part;
    for (std::size_t i = 0; i < 3; ++i) sum += part / 3 * map.images.row(nodes[i]).transpose();
  }
  EXPECT_LT(sum.norm() / area, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ConformalMapOfShapes,
                         ::testing::Values(shapes::ShapeKind::ellipsoid, shapes::ShapeKind::capsule,
                                           shapes::ShapeKind::peanut, shapes::ShapeKind::tips),
                         [](const auto& info) { return std::string(name_of(info.param)); });

/// Meshes anew with elements of one diameter.
std::optional<adapt::Remeshed> remeshed(const mesh::Surface& surface, double diameter,
                                        double max_nodes = 1e6) {
  const fem::NodalShapeOperator flat = fem::NodalShapeOperator::Zero(surface.positions.rows(), 6);
  BisectionOptions options;
  options.max_size = diameter;
  return conformal_remesh(surface, flat, {}, options, max_nodes);
}

class ConformalRemeshOfShapes : public ::testing::TestWithParam<shapes::ShapeKind> {};

TEST_P(ConformalRemeshOfShapes, LaysAGoodMeshOnTheOldSurface) {
  const mesh::Surface old = shape(GetParam(), 8);
  const auto found = remeshed(old, 0.2);
  ASSERT_TRUE(found.has_value());
  const auto& surface = found->surface;
  EXPECT_EQ(surface.triangulation->euler_characteristic(), 2);
  EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.36);  // sphere mesh: 0.48
  EXPECT_LE(diameters(surface).maxCoeff(), 0.2);
  EXPECT_LT(
      (mesh::interpolate(*old.triangulation, found->origins, old.positions) - surface.positions)
          .cwiseAbs()
          .maxCoeff(),
      1e-13);
  const double volume = mesh::enclosed_volume(*old.triangulation, old.positions);
  EXPECT_NEAR(mesh::enclosed_volume(*surface.triangulation, surface.positions) / volume, 1, 2e-4);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ConformalRemeshOfShapes,
                         ::testing::Values(shapes::ShapeKind::sphere, shapes::ShapeKind::ellipsoid,
                                           shapes::ShapeKind::capsule, shapes::ShapeKind::peanut),
                         [](const auto& info) { return std::string(name_of(info.param)); });

TEST(ConformalRemesh, HealsABadMesh) {
  mesh::Surface surface = shape(shapes::ShapeKind::sphere, 8);
  for (auto x : surface.positions.rowwise()) {  // nodes pressed towards the plane x = y
    x(0) += 0.9 * x(1);
    x.normalize();
  }
  ASSERT_LT(mesh::quality(*surface.triangulation, surface.positions), 0.45);
  const auto found = remeshed(surface, 0.2);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(mesh::quality(*found->surface.triangulation, found->surface.positions), 0.44);
}

TEST(ConformalRemesh, StaysBelowTheLargestNumberOfNodes) {
  const auto found = remeshed(shape(shapes::ShapeKind::ellipsoid, 6), 0.05, 1500);
  ASSERT_TRUE(found.has_value());
  EXPECT_LE(found->surface.triangulation->num_nodes(), 1500);
  EXPECT_GT(found->surface.triangulation->num_nodes(), 1000);
}

TEST(ConformalRemesh, RefusesATorus) {
  try {
    (void)remeshed(shape(shapes::ShapeKind::torus, 4), 0.2);
    ADD_FAILURE() << "nothing thrown";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "conformal map: the surface has genus 1: must be 0");
  }
}

}  // namespace
}  // namespace vesica::paper
