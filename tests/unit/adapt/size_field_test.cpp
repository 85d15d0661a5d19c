#include "vesica/adapt/size_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nodal_shape_operators.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::adapt {
namespace {

constexpr double pi = std::numbers::pi;

mesh::Surface sphere(int resolution, double radius = 1) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.resolution = resolution;
  options.radius = radius;
  return shapes::make_shape(options);
}

fem::NodeGraph graph_of(const mesh::Surface& surface) {
  return fem::NodeGraph(*surface.triangulation);
}

Eigen::VectorXd sizes_of(const mesh::Surface& surface, const PhaseInterface& phases,
                         const SizeFieldOptions& options) {
  return size_field(surface, graph_of(surface), test::recovered(surface), phases, options);
}

TEST(SizeField, IsTheCurvatureAngleOverTheNormOfTheShapeOperator) {
  const Eigen::VectorXd sizes = sizes_of(sphere(8, 0.5), {}, {});
  const double norm = std::sqrt(2.0) / 0.5;
  EXPECT_NEAR(sizes.minCoeff(), 0.4 / norm, 2e-3);
  EXPECT_NEAR(sizes.maxCoeff(), 0.4 / norm, 2e-3);
}

TEST(SizeField, IsAtMostTheLargestSizeAlsoWhereTheSurfaceIsFlat) {
  const mesh::Surface surface = sphere(2);
  const fem::NodalShapeOperator flat = fem::NodalShapeOperator::Zero(surface.positions.rows(), 6);
  const Eigen::VectorXd sizes = size_field(surface, graph_of(surface), flat, {}, {});
  EXPECT_EQ(sizes.minCoeff(), 0.3);
  EXPECT_EQ(sizes.maxCoeff(), 0.3);
}

TEST(SizeField, IsSmallInTheInterfaceAndGrowsAwayFromIt) {
  const mesh::Surface surface = sphere(16);
  PhaseInterface phases{Eigen::VectorXd(surface.positions.rows()), 0.1};
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    phases.order_parameter[i] = std::tanh(surface.positions(i, 2) / phases.width);
  }
  SizeFieldOptions options;
  options.max_size = 0.25;
  options.curvature_angle = 1;
  const Eigen::VectorXd sizes = sizes_of(surface, phases, options);
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    const double height = std::abs(std::asin(std::min(1.0, std::abs(surface.positions(i, 2)))));
    if (std::abs(phases.order_parameter[i]) < 0.95) {
      EXPECT_EQ(sizes[i], 0.085);
    } else {
      // 0.085 up to tanh(s / 0.1) = 0.95, then growth 0.25; paths along edges are up to 16 %
      // longer.
      const double away = std::max(0.0, height - 0.18);
      EXPECT_LE(sizes[i], std::min(0.25, 0.085 + 0.25 * 1.16 * (away + 0.05)));
      EXPECT_GE(sizes[i], std::min(0.25, 0.085 + 0.25 * away - 0.015));
    }
  }
  EXPECT_EQ(sizes.maxCoeff(), 0.25);
}

TEST(SizeField, GrowsNoFasterThanAsked) {
  const mesh::Surface surface = sphere(6);
  fem::NodalShapeOperator q = fem::NodalShapeOperator::Zero(surface.positions.rows(), 6);
  q(0, 0) = 10;  // one sharp place
  SizeFieldOptions options;
  options.max_size = 2;
  const Eigen::VectorXd sizes = size_field(surface, graph_of(surface), q, {}, options);
  EXPECT_NEAR(sizes[0], 0.04, 1e-15);
  for (const auto& nodes : surface.triangulation->triangles()) {
    for (const auto a : nodes) {
      for (const auto b : nodes) {
        const double distance = (surface.positions.row(a) - surface.positions.row(b)).norm();
        EXPECT_LE(sizes[a] - sizes[b], 0.25 * distance + 1e-14);
      }
    }
  }
  EXPECT_GT(sizes.maxCoeff(), 0.04 + 0.25 * 2);  // the other end of the diameter
}

TEST(WantedNodes, CountsEquilateralTriangles) {
  const mesh::Surface surface = sphere(8);
  const Eigen::VectorXd sizes = Eigen::VectorXd::Constant(surface.positions.rows(), 0.1);
  EXPECT_NEAR(wanted_nodes(surface, sizes), 8 / std::sqrt(3.0) * 4 * pi / 0.01, 20);
}

TEST(LimitedSizes, KeepToTheLargestNumberOfNodes) {
  const mesh::Surface surface = sphere(4);
  const Eigen::VectorXd sizes = Eigen::VectorXd::Constant(surface.positions.rows(), 0.1);
  const Eigen::VectorXd limited = limited_sizes(surface, sizes, 1000);
  EXPECT_NEAR(wanted_nodes(surface, limited), 1000, 1e-9);
  EXPECT_EQ(limited_sizes(surface, sizes, 1e6), sizes);
}

TEST(LongestRelativeEdge, IsMeasuredInTheMeanSizeAtItsEnds) {
  const mesh::Surface surface = sphere(1);
  const double longest = 4 / std::sqrt(10 + 2 * std::sqrt(5.0));  // of an icosahedron, radius 1
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(42, 0.5);
  EXPECT_NEAR(longest_relative_edge(surface, sizes), longest / 0.5, 1e-12);
  const mesh::NodeIndex corner = surface.triangulation->triangles().front()[0];
  sizes[corner] = 0.1;  // the edges of the icosahedron are equally long
  EXPECT_NEAR(longest_relative_edge(surface, sizes), longest / 0.3, 1e-9);
}

TEST(SizeField, RefusesArraysOfTheWrongLength) {
  const mesh::Surface surface = sphere(1);
  const fem::NodalShapeOperator q = fem::NodalShapeOperator::Zero(42, 6);
  try {
    (void)size_field(surface, graph_of(surface), q, {Eigen::VectorXd::Zero(41), 0.1}, {});
    ADD_FAILURE() << "nothing thrown";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "size field: order_parameter has 41 rows: must have one for each of the 42 nodes");
  }
}

}  // namespace
}  // namespace vesica::adapt
