#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface_samples.hpp"
#include "vesica/measure/diagnostics.hpp"

namespace vesica::measure {
namespace {

ShapeNumbers numbers_of(const mesh::Surface& surface) {
  return shape_numbers({{}, false, {}}, problem::state_of(surface));
}

/// Turned and moved, so that nothing lies along the axes.
mesh::Surface turned(mesh::Surface surface) {
  const Eigen::AngleAxisd rotation(0.8, Eigen::Vector3d(1, 2, -0.5).normalized());
  surface.positions = (surface.positions * rotation.toRotationMatrix().transpose()).eval();
  surface.positions.rowwise() += Eigen::RowVector3d(3, -1, 2);
  return surface;
}

/// Capsule or sphere nodes mapped to rho(x) / distance from the x axis: surface of revolution over
/// x in [-1, 1].
template <class Radius>
mesh::Surface revolution(int resolution, double half_length, const Radius& radius) {
  auto surface = problem::unit_sphere(resolution);
  for (auto row : surface.positions.rowwise()) {
    const double s = row[0];
    row[0] = half_length * s;
    row.tail<2>() *= radius(s);
  }
  return surface;
}

/// Waist of radius `waist` at x = 0.
mesh::Surface peanut(int resolution, double half_length, double waist) {
  return revolution(resolution, half_length, [&](double s) { return waist + 0.9 * s * s; });
}

Eigen::VectorXd signed_field(const mesh::Surface& surface, const auto& function) {
  Eigen::VectorXd c(surface.positions.rows());
  for (Eigen::Index i = 0; i < c.size(); ++i)
    c[i] = function(Eigen::RowVector3d(surface.positions.row(i)));
  return c;
}

TEST(ShapeNumbersTest, OfASphereAreItsRadiusReducedVolumeOneAndItsDiameter) {
  auto surface = problem::unit_sphere(8);
  surface.positions *= 2.5;
  const auto numbers = numbers_of(turned(surface));
  EXPECT_NEAR(numbers.characteristic_radius, 2.5, 1e-5);
  EXPECT_NEAR(numbers.reduced_volume, 1, 1e-5);
  EXPECT_NEAR(*numbers.length, 5, 1e-4);
  EXPECT_FALSE(numbers.neck_radius);
}

TEST(ShapeNumbersTest, OfTheCapsuleAreThoseOfItsClosedForm) {
  const auto numbers = numbers_of(turned(problem::capsule(6)));
  const double pi = std::numbers::pi;
  EXPECT_NEAR(numbers.characteristic_radius, 1, 1e-4);
  EXPECT_NEAR(numbers.reduced_volume, 11 * pi / 12 / (4 * pi / 3), 1e-4);
  EXPECT_NEAR(*numbers.length, 4, 1e-3);
  EXPECT_FALSE(numbers.neck_radius);
}

TEST(ShapeNumbersTest, LengthOfAnEllipsoidIsItsLongAxisThoughNoNodeIsAtItsTips) {
  auto surface = problem::unit_sphere(8);  // 2562 nodes
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.7).normalized();
  for (auto row : surface.positions.rowwise()) row += row.dot(axis) * axis.transpose();
  const Eigen::VectorXd heights = surface.positions * axis;
  EXPECT_LT(heights.maxCoeff(), 2 - 2e-4);
  EXPECT_NEAR(*numbers_of(surface).length, 4, 1e-4 * 4);
  EXPECT_NEAR(*numbers_of(turned(problem::ellipsoid({1, 0.7, 2}, 8))).length, 4, 1e-4 * 4);
}

TEST(ShapeNumbersTest, LengthIsFoundInsideAnElement) {
  // an icosahedron face, not a node, points along (1, 1, 1)
  auto surface = problem::unit_sphere(2);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 1, 1).normalized();
  for (auto row : surface.positions.rowwise()) row += row.dot(axis) * axis.transpose();
  const double nodes =
      (surface.positions * axis).maxCoeff() - (surface.positions * axis).minCoeff();
  const double length = *numbers_of(surface).length;
  EXPECT_GT(length, nodes + 0.02);
  EXPECT_NEAR(length, 4, 0.01);
}

TEST(ShapeNumbersTest, LengthOfAnOblateIsItsLargestExtentAndItHasNoNeck) {
  const auto numbers = numbers_of(turned(problem::ellipsoid({1.5, 0.6, 1.5}, 8)));
  EXPECT_NEAR(*numbers.length, 3, 1e-3);
  EXPECT_FALSE(numbers.neck_radius);
}

TEST(ShapeNumbersTest, LengthOfAThreeTippedShapeGoesFromTipToTip) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::tips;
  options.number_of_tips = 3;
  options.resolution = 6;
  const auto surface = turned(shapes::make_shape(options));
  double diameter = 0;
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    diameter = std::max(
        diameter,
        (surface.positions.rowwise() - surface.positions.row(i)).rowwise().norm().maxCoeff());
  }
  const double length = *numbers_of(surface).length;
  EXPECT_GE(length, diameter);  // the quadratic surface reaches beyond its nodes
  EXPECT_LT(length, 1.002 * diameter);
}

TEST(ShapeNumbersTest, NeckOfAPeanutIsItsWaist) {
  for (const double waist : {0.1, 0.3, 0.6}) {
    const auto numbers = numbers_of(turned(peanut(8, 2, waist)));
    ASSERT_TRUE(numbers.neck_radius) << waist;
    EXPECT_NEAR(*numbers.neck_radius, waist, 1e-3 * waist) << waist;
    EXPECT_NEAR(*numbers.length, 4, 1e-3);
  }
}

TEST(ShapeNumbersTest, NeckConvergesWithTheFourthPowerOfTheMeshSizeOrNearly) {
  const auto error = [](int resolution) {
    return std::abs(*numbers_of(peanut(resolution, 2, 0.3)).neck_radius - 0.3);
  };
  EXPECT_GT(error(6), 1e-9);
  EXPECT_LT(error(12), error(6) / 6);
}

TEST(ShapeNumbersTest, NeckIsTheSmallestOfSeveral) {
  const auto factor = [](double s) {  // three lobes with different necks near s = -+0.4
    return 0.8 - 0.5 * std::exp(-20 * std::pow(s - 0.4, 2)) -
           0.4 * std::exp(-20 * std::pow(s + 0.4, 2));
  };
  double smallest = 1;
  for (double s = 0.2; s < 0.6; s += 1e-4) {
    smallest = std::min(smallest, factor(s) * std::sqrt(1 - s * s));
  }
  const auto numbers = numbers_of(turned(revolution(14, 3, factor)));
  EXPECT_NEAR(*numbers.neck_radius, smallest, 2e-3 * smallest);
}

TEST(ShapeNumbersTest, ConvexAndTwoLoopShapesHaveNoNeck) {
  EXPECT_FALSE(numbers_of(turned(problem::ellipsoid({2, 1, 1}, 6))).neck_radius);
  EXPECT_FALSE(numbers_of(turned(problem::ellipsoid({3, 1, 0.8}, 6))).neck_radius);
  EXPECT_FALSE(numbers_of(problem::capsule(3)).neck_radius);
  // a stretched torus: the cuts across its hole have two loops
  auto ring = problem::torus(1, 0.3, 10);
  ring.positions.col(0) *= 1.5;
  EXPECT_FALSE(numbers_of(turned(ring)).neck_radius);
}

TEST(ShapeNumbersTest, OfASinglePhaseVesicleHaveNoPhaseNumbers) {
  const auto numbers = numbers_of(problem::unit_sphere(2));
  EXPECT_FALSE(numbers.phase_fraction || numbers.reduced_line_tension || numbers.rigidity_ratio);
  EXPECT_FALSE(numbers.saddle_splay_difference || numbers.domains_1 || numbers.domains_2);
}

TEST(ShapeNumbersTest, OfTwoPhasesAreTheDimensionlessNumbersOfThePaper) {
  auto surface = problem::unit_sphere(8);
  surface.positions *= 2;
  model::Model model;
  model.material.bending_rigidity = {2, 5};
  model.material.gaussian_rigidity = {1, -3};
  model.material.line_tension = 1.5;
  const auto c = Eigen::VectorXd::Constant(surface.positions.rows(), 0.5);  // h = 0.6875
  const auto numbers = shape_numbers(model, problem::state_of(surface, c));
  EXPECT_NEAR(*numbers.phase_fraction, 0.5 * (1 - 0.6875), 1e-12);
  EXPECT_NEAR(*numbers.reduced_line_tension, 2 * 4.0 / 3 * 1.5 / 2, 1e-5);
  EXPECT_EQ(*numbers.rigidity_ratio, 2.5);
  EXPECT_EQ(*numbers.saddle_splay_difference, 2);
}

TEST(Domains, AreCountedPhaseByPhase) {
  const auto surface = problem::unit_sphere(4);
  const auto count = [&](const auto& function) {
    const auto numbers =
        shape_numbers({}, problem::state_of(surface, signed_field(surface, function)));
    return std::pair(*numbers.domains_1, *numbers.domains_2);
  };
  using Row = Eigen::RowVector3d;
  EXPECT_EQ(count([](const Row&) { return 1.0; }), std::pair(1, 0));
  EXPECT_EQ(count([](const Row&) { return -1.0; }), std::pair(0, 1));
  EXPECT_EQ(count([](const Row&) { return 0.0; }), std::pair(0, 0));
  EXPECT_EQ(count([](const Row& x) { return x[0] + 0.01; }), std::pair(1, 1));
  EXPECT_EQ(count([](const Row& x) { return std::abs(x[2]) - 0.6; }), std::pair(2, 1));
  EXPECT_EQ(count([](const Row& x) { return 0.6 - std::abs(x[2]); }), std::pair(1, 2));
  EXPECT_EQ(count([](const Row& x) { return x.cwiseAbs().maxCoeff() - 0.85; }), std::pair(6, 1));
}

TEST(Domains, OfASingleNodeCount) {
  const auto surface = problem::unit_sphere(4);
  Eigen::VectorXd c = Eigen::VectorXd::Constant(surface.positions.rows(), -1);
  c[surface.triangulation->triangles()[7][4]] = 1;  // a mid-edge node
  const auto numbers = shape_numbers({}, problem::state_of(surface, c));
  EXPECT_EQ(*numbers.domains_1, 1);
  EXPECT_EQ(*numbers.domains_2, 1);
}

}  // namespace
}  // namespace vesica::measure
