#include "vesica/measure/self_intersection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "shape_measures.hpp"

namespace vesica::measure {
namespace {

using test::pi;

constexpr std::size_t all = 1000000;

/// A torus whose tube is thicker than its ring: it meets itself on the axis at
/// z = -+sqrt(minor^2 - major^2).
mesh::Surface spindle(double major, double minor, int resolution) {
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::torus, resolution);
  options.major_radius = 1;
  options.minor_radius = 0.4;
  mesh::Surface surface = shapes::make_shape(options);
  for (auto row : surface.positions.rowwise()) {
    const double around = std::atan2(row[1], row[0]);
    const double along = std::atan2(row[2], std::hypot(row[0], row[1]) - 1);
    const double rho = major + minor * std::cos(along);
    row << rho * std::cos(around), rho * std::sin(around), minor * std::sin(along);
  }
  return surface;
}

/// Unit sphere whose north pole is pushed down by `depth`, in a dent of radius 0.4.
mesh::Surface dented(double depth, int resolution) {
  mesh::Surface surface = shapes::make_shape(test::shape(shapes::ShapeKind::sphere, resolution));
  for (auto row : surface.positions.rowwise()) {
    const double rho_squared = row[0] * row[0] + row[1] * row[1];
    if (row[2] > 0) row[2] -= depth * std::exp(-rho_squared / 0.16);
  }
  return surface;
}

TEST(SelfIntersection, IsNotFoundOnSurfacesThatHaveNone) {
  for (const shapes::ShapeKind kind :
       {shapes::ShapeKind::sphere, shapes::ShapeKind::capsule, shapes::ShapeKind::tips,
        shapes::ShapeKind::ellipsoid, shapes::ShapeKind::torus}) {
    EXPECT_TRUE(self_intersections(shapes::make_shape(test::shape(kind, 8)), all).empty());
  }
  shapes::ShapeOptions peanut = test::shape(shapes::ShapeKind::peanut, 8);
  peanut.waist = 0.04;
  EXPECT_TRUE(self_intersections(shapes::make_shape(peanut), all).empty());
  EXPECT_TRUE(self_intersections(dented(1.9, 12), all).empty());
}

TEST(SelfIntersection, OfASpindleTorusIsOnItsAxis) {
  const double height = std::sqrt(1 - 0.36);
  const auto farthest = [&](int resolution) {
    const auto pairs = self_intersections(spindle(0.6, 1, resolution), all);
    double distance = 0;
    bool is_high = false;
    bool is_low = false;
    for (const auto& pair : pairs) {
      (pair.point.z() > 0 ? is_high : is_low) = true;
      const Eigen::Vector3d exact(0, 0, std::copysign(height, pair.point.z()));
      distance = std::max(distance, (pair.point - exact).norm());
    }
    EXPECT_TRUE(is_high && is_low);
    return distance;
  };
  const double coarse = farthest(12);
  EXPECT_LT(coarse, 0.3);
  EXPECT_LT(farthest(36), coarse / 2);
}

TEST(SelfIntersection, OfADentThatGoesThroughTheOtherSideIsACircle) {
  const double depth = 2.3;
  // sqrt(1 - rho^2) - depth exp(-rho^2 / 0.16) = -sqrt(1 - rho^2)
  double rho = 0;
  while (2 * std::sqrt(1 - rho * rho) < depth * std::exp(-rho * rho / 0.16)) rho += 1e-5;
  ASSERT_GT(rho, 0.1);
  const auto pairs = self_intersections(dented(depth, 20), all);
  EXPECT_GT(pairs.size(), 8U);
  for (const auto& pair : pairs) {
    EXPECT_NEAR(pair.point.head<2>().norm(), rho, 0.02);
    EXPECT_NEAR(pair.point.z(), -std::sqrt(1 - rho * rho), 0.02);
    EXPECT_LT(pair.triangles[0], pair.triangles[1]);
  }
}

TEST(SelfIntersection, IsReportedUpToANumberOfPairs) {
  const mesh::Surface surface = dented(2.3, 12);
  const auto pairs = self_intersections(surface, all);
  ASSERT_GT(pairs.size(), 3U);
  const auto first = self_intersections(surface, 2);
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[1].triangles, pairs[1].triangles);
}

TEST(SelfIntersection, CostsLittle) {
  const mesh::Surface surface =
      shapes::make_shape(test::shape(shapes::ShapeKind::sphere, 19));  // 14442 nodes
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(self_intersections(surface, all).empty());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(elapsed.count(), 1);  // 0.02 s on a machine that is not busy
}

}  // namespace
}  // namespace vesica::measure
