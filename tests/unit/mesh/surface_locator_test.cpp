#include "vesica/mesh/surface_locator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "shape_measures.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::mesh {
namespace {

using Eigen::Vector3d;

SurfaceLocator locator_of(const Surface& surface) {
  return {surface.triangulation, surface.positions};
}

Vector3d random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

/// Distance to the closest of many points of every triangle.
double sampled_distance(const SurfaceLocator& locator, const Vector3d& point, int pieces) {
  double smallest = std::numeric_limits<double>::infinity();
  for (NodeIndex t = 0; t < locator.triangulation().num_triangles(); ++t) {
    for (int i = 0; i <= pieces; ++i) {
      for (int j = 0; i + j <= pieces; ++j) {
        const SurfaceLocation location{t, static_cast<double>(i) / pieces,
                                       static_cast<double>(j) / pieces, Vector3d::Zero(), 0};
        const Vector3d sample = locator.interpolate(location, locator.positions());
        smallest = std::min(smallest, (sample - point).norm());
      }
    }
  }
  return smallest;
}

TEST(SurfaceLocator, FindsEveryNodeAtDistanceZero) {
  const Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::tips, 3));
  const SurfaceLocator locator = locator_of(surface);
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    const Vector3d node = surface.positions.row(i);
    const SurfaceLocation found = locator.closest(node);
    ASSERT_LT(found.distance, 1e-14);
    ASSERT_LT((found.point - node).norm(), 1e-14);
    ASSERT_LT((locator.interpolate(found, surface.positions) - node).norm(), 1e-14);
  }
}

TEST(SurfaceLocator, IsExactOnAFlatSidedSurface) {
  const SurfaceLocator locator = locator_of(test::octahedron());
  const SurfaceLocation above_face = locator.closest({1, 1, 1});
  EXPECT_LT((above_face.point - Vector3d::Constant(1.0 / 3)).norm(), 1e-14);
  EXPECT_NEAR(above_face.distance, 2 / std::sqrt(3.0), 1e-14);
  const SurfaceLocation above_edge = locator.closest({1, 1, 0});
  EXPECT_LT((above_edge.point - Vector3d(0.5, 0.5, 0)).norm(), 1e-14);
  const SurfaceLocation above_corner = locator.closest({3, 0.5, -0.5});
  EXPECT_LT((above_corner.point - Vector3d(1, 0, 0)).norm(), 1e-14);
}

TEST(SurfaceLocator, AgreesWithDenseSamplingNearAndFar) {
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::tips, 2);
  options.tip_height = 0.8;
  const SurfaceLocator locator = locator_of(shapes::make_shape(options));
  std::mt19937 random(1);
  constexpr int pieces = 40;
  for (int sample = 0; sample < 60; ++sample) {
    const Vector3d point = random_point(random, 2);
    const double sampled = sampled_distance(locator, point, pieces);
    const double found = locator.closest(point).distance;
    ASSERT_LE(found, sampled * (1 + 1e-12)) << "point " << point.transpose();
    ASSERT_GE(found, sampled - 0.03) << "point " << point.transpose();
  }
}

TEST(SurfaceLocator, EndsWhereTheOffsetIsNormalToTheSurfaceOrToAnEdge) {
  const SurfaceLocator locator =
      locator_of(shapes::make_shape(test::shape(shapes::ShapeKind::torus, 8)));
  std::mt19937 random(2);
  int num_inside = 0;
  for (int sample = 0; sample < 200; ++sample) {
    const Vector3d point = random_point(random, 1.3);
    const SurfaceLocation found = locator.closest(point);
    ASSERT_GE(found.u, 0);
    ASSERT_GE(found.v, 0);
    ASSERT_LE(found.u + found.v, 1 + 1e-15);
    ASSERT_NEAR(found.distance, (found.point - point).norm(), 1e-14);
    const bool is_inside = found.u > 1e-9 && found.v > 1e-9 && found.u + found.v < 1 - 1e-9;
    if (!is_inside) continue;
    ++num_inside;
    ASSERT_LT((point - found.point).cross(locator.normal(found)).norm(), 1e-9);
  }
  EXPECT_GT(num_inside, 100);
}

TEST(SurfaceLocator, DistanceToASphereConvergesWithThirdOrderOrBetter) {
  const auto error = [](int resolution) {
    const SurfaceLocator locator =
        locator_of(shapes::make_shape(test::shape(shapes::ShapeKind::sphere, resolution)));
    std::mt19937 random(3);
    double largest = 0;
    for (int sample = 0; sample < 300; ++sample) {
      const Vector3d point = random_point(random, 2);
      const double exact = std::abs(point.norm() - 1);
      if (point.norm() < 0.3) continue;  // near the centre every point of the sphere is closest
      largest = std::max(largest, std::abs(locator.closest(point).distance - exact));
    }
    return largest;
  };
  const double coarse = error(4);
  const double fine = error(8);
  EXPECT_GT(std::log2(coarse / fine), 2.8);
  EXPECT_LT(fine, 2e-5);
}

TEST(SurfaceLocator, KeepsToTheSheetWithTheGivenNormal) {
  // Two sheets 0.1 apart, normals up and down.
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::ellipsoid, 6);
  options.semi_axes << 1, 1, 0.05;
  const SurfaceLocator locator = locator_of(shapes::make_shape(options));
  const Vector3d point(0.1, 0.2, 0.03);  // nearer to the upper sheet
  EXPECT_GT(locator.closest(point).point.z(), 0);
  EXPECT_GT(locator.closest(point, {0, 0, 2}).point.z(), 0);
  const SurfaceLocation lower = locator.closest(point, {0, 0, -1});
  EXPECT_LT(lower.point.z(), 0);
  EXPECT_LT(locator.normal(lower).z(), 0);
  EXPECT_NEAR(lower.distance, 0.08, 5e-3);
}

TEST(SurfaceLocator, WalksToTheClosestPointFromNearby) {
  const Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::torus, 12));
  const SurfaceLocator locator = locator_of(surface);
  std::mt19937 random(5);
  for (const QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    const Vector3d from = surface.positions.row(nodes[0]);  // a corner belongs to six triangles
    const Vector3d point = from + random_point(random, 0.05);
    const SurfaceLocation walked = locator.closest_from(locator.closest(from), point);
    // Off the surface the edges, where the normal jumps, have local minima of their own.
    ASSERT_NEAR(walked.distance, locator.closest(point).distance, 1e-5);
  }
}

TEST(SurfaceLocator, StaysOnTheSheetWhereTheWalkStarts) {
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::ellipsoid, 6);
  options.semi_axes << 1, 1, 0.05;
  const SurfaceLocator locator = locator_of(shapes::make_shape(options));
  const SurfaceLocation lower = locator.closest({0.1, 0.2, -1});
  EXPECT_LT(locator.closest_from(lower, {0.15, 0.2, 0.03}).point.z(), 0);
}

TEST(SurfaceLocator, FallsBackToThePlainClosestPointWithoutASuitableNormal) {
  const SurfaceLocator locator = locator_of(test::octahedron());
  const SurfaceLocation found = locator.closest({1, 1, 1}, {0, 0, 0});
  EXPECT_LT((found.point - Vector3d::Constant(1.0 / 3)).norm(), 1e-14);
}

TEST(SurfaceLocator, InterpolatesQuadraticFieldsExactlyOnFlatSides) {
  const Surface surface = test::octahedron();
  const SurfaceLocator locator = locator_of(surface);
  const auto quadratic = [](const Vector3d& x) { return 1 + x.x() * x.y() - 2 * x.z() * x.z(); };
  Eigen::VectorXd field(surface.positions.rows());
  for (Eigen::Index i = 0; i < field.size(); ++i) field[i] = quadratic(surface.positions.row(i));
  std::mt19937 random(4);
  std::vector<SurfaceLocation> locations;
  for (int sample = 0; sample < 20; ++sample) {
    locations.push_back(locator.closest(random_point(random, 1)));
    EXPECT_NEAR(locator.interpolate(locations.back(), field).value(),
                quadratic(locations.back().point), 1e-14);
  }
  const Eigen::VectorXd values = locator.interpolate(locations, field);
  const Positions points = locator.interpolate(locations, surface.positions);
  ASSERT_EQ(values.size(), 20);
  EXPECT_NEAR(values[19], quadratic(locations[19].point), 1e-14);
  EXPECT_LT((points.row(7).transpose() - locations[7].point).norm(), 1e-14);
}

TEST(SurfaceLocator, RefusesWhatIsNotFiniteOrTooShort) {
  Surface surface = test::octahedron();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  test::expect_message<ConfigError>(
      [&] {
        (void)locator_of(surface).closest({0, nan, 1});
      },
      "surface locator: point (0, nan, 1): must be finite");
  surface.positions(3, 1) = nan;
  test::expect_message<ConfigError>([&] { (void)locator_of(surface); },
                                    "surface locator: positions: must be finite");
  surface.positions = Positions(surface.positions.topRows(5));
  test::expect_message<ConfigError>(
      [&] { (void)locator_of(surface); },
      "surface locator: 5 positions: must be one for each of the 18 nodes");
}

}  // namespace
}  // namespace vesica::mesh
