#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shape_measures.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {
namespace {

using test::area_of;
using test::largest_distance;
using test::order;
using test::pi;
using test::quality_of;
using test::shape;
using test::volume_of;

TEST(Capsule, OfLength4Has72MSquaredPlus2Nodes) {
  for (const auto& [resolution, nodes] : {std::pair{4, 1154}, {6, 2594}, {8, 4610}, {14, 14114}}) {
    EXPECT_EQ(make_shape(test::shape(ShapeKind::capsule, resolution)).positions.rows(), nodes);
  }
}

TEST(Capsule, HasAllNodesOnTheCylinderAndItsHemispheres) {
  for (const double length : {1.0, 1.6, 4.0}) {
    ShapeOptions options = test::shape(ShapeKind::capsule, 5);
    options.length = length;
    const mesh::Surface surface = make_shape(options);
    const double distance = test::largest_distance(surface, [&](const Eigen::Vector3d& x) {
      const Eigen::Vector3d centre(std::clamp(x.x(), 0.5, length - 0.5), 0.5, 0.5);
      return (x - centre).norm() - 0.5;
    });
    EXPECT_LT(distance, 1e-14) << length;
    EXPECT_NEAR(surface.positions.col(0).minCoeff(), 0, length > 1 ? 0.02 : 0.05);
    EXPECT_NEAR(surface.positions.col(0).maxCoeff(), length, length > 1 ? 0.02 : 0.05);
  }
}

TEST(Capsule, HasItsPolesAtNodesWhenTheNumberOfSquaresIsEven) {
  const mesh::Surface surface = make_shape(test::shape(ShapeKind::capsule, 4));
  EXPECT_NEAR(surface.positions.col(0).minCoeff(), 0, 1e-15);
  EXPECT_NEAR(surface.positions.col(0).maxCoeff(), 4, 1e-15);
}

TEST(Capsule, HasWellShapedTrianglesOfNearlyEqualSize) {
  for (const int resolution : {4, 6, 8, 14}) {
    const mesh::Surface surface = make_shape(test::shape(ShapeKind::capsule, resolution));
    EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.57) << resolution;
    EXPECT_LT(mesh::area_ratio(*surface.triangulation, surface.positions), 1.45) << resolution;
  }
  EXPECT_GT(test::quality_of(test::shape(ShapeKind::capsule, 5)), 0.5);
}

TEST(Capsule, IsMirrorSymmetricWhenTheNumberOfSquaresIsEven) {
  const mesh::Surface surface = make_shape(test::shape(ShapeKind::capsule, 4));
  const mesh::Positions& x = surface.positions;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::RowVector3d twice_centre(4, 1, 1);
    double worst = 0;
    for (Eigen::Index node = 0; node < x.rows(); ++node) {
      Eigen::RowVector3d image = x.row(node);
      image(axis) = twice_centre(axis) - image(axis);
      worst = std::max(worst, (x.rowwise() - image).rowwise().norm().minCoeff());
    }
    EXPECT_LT(worst, 1e-14) << "axis " << axis;
  }
}

TEST(Capsule, ConvergesToItsExactAreaAndVolume) {
  const ShapeOptions options = test::shape(ShapeKind::capsule, 1);
  EXPECT_GT(test::order(area_of, 4 * pi, options, 8, 14), 1.95);
  // Third order: curvature jumps inside the elements over the seams of cylinder and hemispheres.
  EXPECT_GT(test::order(volume_of, 11 * pi / 12, options, 6, 14), 2.8);
  ShapeOptions thick = options;
  thick.length = 5;
  thick.diameter = 2;
  EXPECT_GT(test::order(area_of, 10 * pi, thick, 8, 14), 1.95);
  EXPECT_GT(test::order(volume_of, 5 * pi - pi * 8 / 12, thick, 6, 14), 2.8);
}

}  // namespace
}  // namespace vesica::shapes
