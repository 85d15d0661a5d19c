#include "vesica/measure/neck.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <optional>

#include "shape_measures.hpp"

namespace vesica::measure {
namespace {

using test::pi;

shapes::ShapeOptions peanut(double waist, int resolution) {
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::peanut, resolution);
  options.waist = 2 * waist;
  return options;
}

shapes::ShapeOptions torus(double major, double minor, int resolution) {
  shapes::ShapeOptions options = test::shape(shapes::ShapeKind::torus, resolution);
  options.major_radius = major;
  options.minor_radius = minor;
  return options;
}

/// Turned and moved, so that nothing lies along the axes.
mesh::Surface turned(mesh::Surface surface) {
  const Eigen::AngleAxisd rotation(0.8, Eigen::Vector3d(1, 2, -0.5).normalized());
  surface.positions = (surface.positions * rotation.toRotationMatrix().transpose()).eval();
  return surface;
}

double area_of(const mesh::Surface& surface) {
  const auto areas = mesh::element_areas(*surface.triangulation, surface.positions);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

TEST(Neck, OfAPeanutIsItsWaist) {
  for (const double waist : {0.03, 0.05, 0.1}) {
    const mesh::Surface surface = shapes::make_shape(peanut(waist, 8));
    const auto neck = find_neck(surface, 2 * pi * 0.15);
    ASSERT_TRUE(neck) << waist;
    EXPECT_NEAR(neck->radius(), waist, 0.06 * waist) << waist;
    EXPECT_LT((neck->centre - Eigen::Vector3d(2, 0.5, 0.5)).norm(), 0.05) << neck->centre;
    EXPECT_TRUE(neck->separates);
    EXPECT_NEAR(neck->smaller_area, neck->larger_area, 0.1 * neck->larger_area);
    EXPECT_NEAR(neck->smaller_area + neck->larger_area, area_of(surface), 1e-9);
  }
}

TEST(Neck, ConvergesToTheWaist) {
  const auto error = [](int resolution) {
    const auto neck = find_neck(turned(shapes::make_shape(peanut(0.06, resolution))), 2 * pi * 0.1);
    return neck ? std::abs(neck->radius() / 0.06 - 1) : 1;
  };
  EXPECT_LT(error(8), 0.06);
  EXPECT_LT(error(16), 0.02);
}

TEST(Neck, IsNoneThatIsLongerThanAskedFor) {
  EXPECT_TRUE(find_neck(shapes::make_shape(peanut(0.09, 8)), 2 * pi * 0.1));
  EXPECT_FALSE(find_neck(shapes::make_shape(peanut(0.11, 8)), 2 * pi * 0.1));
}

TEST(Neck, TellsTheSharesOfBothSides) {
  // The waist moved towards the low end, so that the low side is the smaller one.
  mesh::Surface surface = shapes::make_shape(peanut(0.05, 8));
  surface.positions.rowwise() -= Eigen::RowVector3d(2, 0.5, 0.5);
  for (auto row : surface.positions.rowwise()) {
    if (row[0] < 0) row *= 0.8;
  }
  const auto neck = find_neck(surface, 2 * pi * 0.1);
  ASSERT_TRUE(neck);
  EXPECT_NEAR(neck->smaller_area / neck->larger_area, 0.64, 0.05);
  const auto along = surface.positions.col(0).array();
  const auto smaller = neck->side_areas.col(0).array();
  const auto larger = neck->side_areas.col(1).array();
  EXPECT_NEAR(smaller.sum(), neck->smaller_area, 1e-9);
  EXPECT_NEAR(larger.sum(), neck->larger_area, 1e-9);
  EXPECT_EQ((along > 0.4 && (smaller > 0 || larger == 0)).count(), 0);
  EXPECT_EQ((along < -0.4 && (smaller == 0 || larger > 0)).count(), 0);
}

TEST(Neck, OfATorusIsItsTubeOrItsHole) {
  const auto tube = find_neck(turned(shapes::make_shape(torus(1, 0.1, 10))), 2 * pi * 0.15);
  ASSERT_TRUE(tube);
  EXPECT_FALSE(tube->separates);
  EXPECT_NEAR(tube->radius(), 0.1, 0.01);
  EXPECT_NEAR(tube->centre.norm(), 1, 0.02);
  const auto hole = find_neck(turned(shapes::make_shape(torus(0.7, 0.6, 24))), 2 * pi * 0.15);
  ASSERT_TRUE(hole);
  EXPECT_FALSE(hole->separates);
  EXPECT_NEAR(hole->radius(), 0.1, 0.01);
  EXPECT_LT(hole->centre.norm(), 0.05);
}

TEST(Neck, IsNotInASphereHoweverLongItMayBe) {
  EXPECT_FALSE(find_neck(shapes::make_shape(test::shape(shapes::ShapeKind::sphere, 6)), 2 * pi));
}

TEST(Neck, IsNotInACigar) {
  shapes::ShapeOptions cigar = test::shape(shapes::ShapeKind::capsule, 6);
  EXPECT_FALSE(find_neck(shapes::make_shape(cigar), 2 * pi * 0.6));
}

TEST(Neck, IsNotATip) {
  shapes::ShapeOptions tips = test::shape(shapes::ShapeKind::tips, 12);
  tips.tip_height = 0.5;
  tips.tip_width = 0.15;
  const mesh::Surface surface = shapes::make_shape(tips);
  EXPECT_FALSE(find_neck(surface, 2 * pi * 0.3));
}

TEST(Neck, IsNotTheRimOfADisc) {
  shapes::ShapeOptions disc = test::shape(shapes::ShapeKind::ellipsoid, 12);
  disc.semi_axes = {1.5, 1.5, 0.15};
  EXPECT_FALSE(find_neck(shapes::make_shape(disc), 2 * pi * 0.3));
}

TEST(Neck, CostsLittle) {
  const mesh::Surface surface = shapes::make_shape(peanut(0.03, 14));  // 14000 nodes
  const auto begin = std::chrono::steady_clock::now();
  const auto neck = find_neck(surface, 2 * pi * 0.06);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(neck);
  EXPECT_LT(elapsed.count(), 2);  // 0.05 s on a machine that is not busy
}

}  // namespace
}  // namespace vesica::measure
