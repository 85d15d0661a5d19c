#include "vesica/mesh/redistribute.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "expect_message.hpp"
#include "shape_measures.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::mesh {
namespace {

using Eigen::Vector3d;

const Vector3d semi_axes(1.5, 1, 0.8);

/// Nodes of a unit sphere drift towards +x by the map (x, y, z) -> (x + a, y, z) / |...|, then the
/// sphere becomes the ellipsoid: exact positions, bad elements.
Surface drifted_ellipsoid(int resolution, double drift) {
  Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::sphere, resolution));
  for (auto x : surface.positions.rowwise()) {
    x(0) += drift;
    x.normalize();
    x.array() *= semi_axes.transpose().array();
  }
  return surface;
}

/// First-order distance to the ellipsoid.
double distance_to_ellipsoid(const Vector3d& x) {
  const Vector3d scaled = x.cwiseQuotient(semi_axes);
  const Vector3d gradient = scaled.cwiseQuotient(semi_axes) / scaled.norm();
  return (scaled.norm() - 1) / gradient.norm();
}

/// Every vertex and mid-edge node of a sphere takes a random step along the sphere.
Surface shaken_sphere(int resolution, double step) {
  Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::sphere, resolution));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-step, step);
  for (auto x : surface.positions.rowwise()) {
    x += Eigen::RowVector3d(coordinate(random), coordinate(random), coordinate(random));
    x.normalize();
  }
  return surface;
}

TEST(Redistribute, EqualisesADriftedMesh) {
  const Surface surface = drifted_ellipsoid(6, 0.6);
  const Redistribution found = redistribute(surface, 20);
  const Triangulation& triangulation = *surface.triangulation;
  EXPECT_LT(area_ratio(triangulation, found.positions),
            0.6 * area_ratio(triangulation, surface.positions));
  EXPECT_GT(quality(triangulation, found.positions), 0.5);
}

TEST(Redistribute, HealsAShakenMesh) {
  const Surface surface = shaken_sphere(6, 0.025);
  const Triangulation& triangulation = *surface.triangulation;
  ASSERT_LT(quality(triangulation, surface.positions), 0.35);
  const Redistribution found = redistribute(surface, 10);
  EXPECT_GT(quality(triangulation, found.positions), 0.6);
  EXPECT_GT(smallest_normal_cosine(triangulation, found.positions), 0.95);
}

TEST(Redistribute, KeepsEqualAreasWhereValencesDiffer) {
  const Surface cigar =
      shapes::make_shape(test::shape(shapes::ShapeKind::capsule, 4));  // valences 3 to 8
  const Redistribution found = redistribute(cigar, 10);
  EXPECT_LT(area_ratio(*cigar.triangulation, found.positions), 1.5);
  EXPECT_GT(quality(*cigar.triangulation, found.positions), 0.55);
}

TEST(Redistribute, PutsEveryNodeOnTheOldSurface) {
  const Surface surface = drifted_ellipsoid(4, 0.5);
  const Redistribution found = redistribute(surface, 5);
  const SurfaceLocator locator(surface.triangulation, surface.positions);
  const Positions at_origins = locator.interpolate(found.origins, surface.positions);
  EXPECT_LT((at_origins - found.positions).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT((found.positions - surface.positions).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Redistribute, KeepsTheShapeToTheOrderOfInterpolation) {
  const auto measure = [](int resolution) {
    const Surface surface = drifted_ellipsoid(resolution, 0.4);
    const Surface moved{surface.triangulation, redistribute(surface, 6).positions};
    const double exact_volume = 4 * test::pi / 3 * semi_axes.prod();
    return std::pair(test::largest_distance(moved, distance_to_ellipsoid),
                     enclosed_volume(*moved.triangulation, moved.positions) - exact_volume);
  };
  const auto coarse = measure(5);
  const auto fine = measure(10);
  EXPECT_GT(std::log2(coarse.first / fine.first), 2.7);
  EXPECT_GT(std::log2(std::abs(coarse.second / fine.second)), 3);
}

TEST(Redistribute, MakesElementsSmallWhereSmallOnesAreWanted) {
  const Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::sphere, 6));
  Eigen::VectorXd sizes(surface.positions.rows());
  for (Eigen::Index i = 0; i < sizes.size(); ++i) sizes[i] = 1.5 - surface.positions(i, 2);
  const Redistribution found = redistribute(surface, 20, sizes);
  const auto areas = element_areas(*surface.triangulation, found.positions);
  double upper = 0;  // areas of the elements that were around the poles
  double lower = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const double z = surface.positions(surface.triangulation->triangles()[t][0], 2);
    if (z > 0.8) upper += areas[t];
    if (z < -0.8) lower += areas[t];
  }
  EXPECT_LT(upper, 0.7 * lower);
  EXPECT_GT(quality(*surface.triangulation, found.positions), 0.5);
}

TEST(Redistribute, LeavesAMeshAloneThatItCannotImprove) {
  const Surface surface = shaken_sphere(6, 0.04);  // folded: its own triangles overlap
  ASSERT_LT(smallest_normal_cosine(*surface.triangulation, surface.positions), -0.9);
  EXPECT_EQ(redistribute(surface, 10).positions, surface.positions);
}

TEST(Redistribute, RefusesSizesThatAreTooFewOrNotPositive) {
  const Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::sphere, 1));
  test::expect_message<ConfigError>(
      [&] { (void)redistribute(surface, 1, Eigen::VectorXd::Ones(3)); },
      "redistribute: 3 sizes: must be one for each of the 42 nodes");
  Eigen::VectorXd sizes = Eigen::VectorXd::Ones(42);
  sizes[7] = 0;
  test::expect_message<ConfigError>([&] { (void)redistribute(surface, 1, sizes); },
                                    "redistribute: size 0 at node 7: must be > 0");
}

}  // namespace
}  // namespace vesica::mesh
