#include "vesica/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::mesh {
namespace {

using test::expect_message;
using test::octahedron;

Surface inside_out(const Surface& surface) {
  std::vector<QuadraticTriangle> turned;
  for (const QuadraticTriangle& n : surface.triangulation->triangles()) {
    turned.push_back({n[0], n[2], n[1], n[5], n[4], n[3]});
  }
  return {std::make_shared<const Triangulation>(turned, surface.triangulation->num_nodes()),
          surface.positions};
}

/// Two octahedra, the second 10 to the right, maybe with inward orientation.
Surface two_octahedra(bool second_is_inside_out) {
  auto triangles = test::octahedron_triangles();
  for (Corners corners : test::octahedron_triangles()) {
    for (NodeIndex& node : corners) node += 6;
    if (second_is_inside_out) std::swap(corners[1], corners[2]);
    triangles.push_back(corners);
  }
  Positions vertices(12, 3);
  vertices << test::octahedron_vertices(), test::octahedron_vertices();
  vertices.bottomRows(6).col(0).array() += 10;
  return test::flat_surface(triangles, vertices);
}

void refuses(const Surface& surface, const std::string& text) {
  expect_message<ConfigError>([&] { (void)check_geometry(surface, false); }, text);
}

TEST(Quality, IsTheSineOf60DegreesForEquilateralTriangles) {
  const Surface surface = octahedron();
  EXPECT_NEAR(quality(*surface.triangulation, surface.positions), std::sqrt(0.75), 1e-14);
}

TEST(Quality, SeesAMidEdgeNodeThatSpoilsASubTriangle) {
  Surface surface = octahedron();
  const NodeIndex middle = surface.triangulation->triangles()[0][3];  // of (+x, +y)
  surface.positions.row(middle) << 0.9, 0.1, 0;
  // Angle at the corner (1, 0, 0) stays 60 degrees; sides 0.1 sqrt(2) and 0.5 sqrt(2) meet there.
  const double opposite = std::sqrt(0.01 + 0.25 - 0.05);
  EXPECT_NEAR(quality(*surface.triangulation, surface.positions), 0.1 * std::sqrt(0.75) / opposite,
              1e-14);
}

TEST(Quality, MeasuresAreasOfAnOctahedron) {
  const Surface surface = octahedron();
  const Triangulation& triangulation = *surface.triangulation;
  EXPECT_NEAR(area_ratio(triangulation, surface.positions), 1.0, 1e-13);
  const std::vector<double> areas = element_areas(triangulation, surface.positions);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 4 * std::sqrt(3.0), 1e-13);
}

TEST(SmallestNormalCosine, IsThatOfTheEdgesOfAnOctahedron) {
  const Surface surface = octahedron();
  // Flat faces agree inside; neighbours' normals (1, 1, 1) and (1, 1, -1) have the cosine 1/3.
  EXPECT_NEAR(smallest_normal_cosine(*surface.triangulation, surface.positions), 1.0 / 3, 1e-14);
}

TEST(SmallestNormalCosine, TendsToOneOnASmoothSurface) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.resolution = 8;
  const Surface surface = shapes::make_shape(options);
  const double cosine = smallest_normal_cosine(*surface.triangulation, surface.positions);
  EXPECT_GT(cosine, 0.98);
  EXPECT_LT(cosine, 1.0);
}

TEST(SmallestNormalCosine, SeesAFoldThatQualityMisses) {
  Surface surface = octahedron();
  // The corner +x goes to the centre: its four sub-triangles stay equilateral and turn over.
  surface.positions.row(0).setZero();
  EXPECT_NEAR(quality(*surface.triangulation, surface.positions), std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(smallest_normal_cosine(*surface.triangulation, surface.positions), -1.0 / 3, 1e-14);
}

TEST(SmallestNormalCosine, IsMinusOneForASubTriangleWithoutArea) {
  Surface surface = octahedron();
  const QuadraticTriangle nodes = surface.triangulation->triangles()[0];
  surface.positions.row(nodes[3]) =
      0.5 * (surface.positions.row(nodes[0]) + surface.positions.row(nodes[5]));
  EXPECT_EQ(smallest_normal_cosine(*surface.triangulation, surface.positions), -1.0);
}

TEST(EnclosedVolume, IsExactForFlatFacesAndDoesNotDependOnTheOrigin) {
  Surface surface = octahedron();
  EXPECT_NEAR(enclosed_volume(*surface.triangulation, surface.positions), 4.0 / 3, 1e-14);
  surface.positions.rowwise() += Eigen::RowVector3d(3, -2, 5);
  EXPECT_NEAR(enclosed_volume(*surface.triangulation, surface.positions), 4.0 / 3, 1e-12);
  EXPECT_NEAR(enclosed_volume(*inside_out(surface).triangulation, surface.positions), -4.0 / 3,
              1e-12);
}

TEST(EnclosedVolume, OfACurvedSurfaceIsInvariantUnderShiftsAndScalesWithTheDeterminant) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::tips;
  options.resolution = 2;
  Surface surface = shapes::make_shape(options);
  const double volume = enclosed_volume(*surface.triangulation, surface.positions);
  surface.positions.rowwise() += Eigen::RowVector3d(1, 2, 3);
  EXPECT_NEAR(enclosed_volume(*surface.triangulation, surface.positions), volume, 1e-12 * volume);
  Eigen::Matrix3d map;
  map << 2, 1, 0, 0, 1, 0.5, 0, 0, 3;  // determinant 6
  surface.positions *= map;
  EXPECT_NEAR(enclosed_volume(*surface.triangulation, surface.positions), 6 * volume,
              1e-11 * volume);
}

TEST(CheckGeometry, ReturnsASoundSurfaceUnchanged) {
  const Surface surface = octahedron();
  const Surface checked = check_geometry(surface, true);
  EXPECT_EQ(checked.triangulation, surface.triangulation);
  EXPECT_EQ(checked.positions, surface.positions);
}

TEST(CheckGeometry, RefusesPositionsThatAreNotFiniteOrTooFew) {
  Surface surface = octahedron();
  surface.positions(7, 1) = std::numeric_limits<double>::quiet_NaN();
  refuses(surface, "surface: node 7 = (");
  surface = octahedron();
  surface.positions.conservativeResize(17, 3);
  refuses(surface, "surface: 17 positions: must be one for each of the 18 nodes");
}

TEST(CheckGeometry, RefusesCoincidentNodes) {
  Surface surface = octahedron();
  const QuadraticTriangle nodes = surface.triangulation->triangles()[0];
  surface.positions.row(nodes[3]) = surface.positions.row(nodes[0]);
  refuses(surface, "triangle 0 (nodes 0, 2, 4): nodes 0 and 6 coincide");
}

TEST(CheckGeometry, RefusesATriangleWithoutArea) {
  Surface surface = octahedron();
  // The middle of edge (+x, +y) moves onto the line through +x and the middle of edge (+z, +x).
  const QuadraticTriangle nodes = surface.triangulation->triangles()[0];
  surface.positions.row(nodes[3]) =
      0.5 * (surface.positions.row(nodes[0]) + surface.positions.row(nodes[5]));
  refuses(surface, "triangle 0 (nodes 0, 2, 4) is degenerate: its area must be > 0");
}

TEST(CheckGeometry, RefusesAFoldedTriangle) {
  Surface surface = octahedron();
  const QuadraticTriangle nodes = surface.triangulation->triangles()[0];
  surface.positions.row(nodes[3]) << 0.1, 0.1, 0.9;  // beyond the line of the other two middles
  refuses(surface, "triangle 0 (nodes 0, 2, 4) is folded");
}

TEST(CheckGeometry, RefusesNeighboursFoldedOntoEachOther) {
  Surface surface = octahedron();
  surface.positions.col(2) *= 0.05;  // a lens whose rim is too sharp
  refuses(surface, "edge (0, 2): its triangles are folded onto each other");
}

TEST(CheckGeometry, RefusesAnInsideOutSurfaceAndFlipsItWhenAsked) {
  const Surface surface = inside_out(octahedron());
  refuses(surface, "triangle 0 (nodes 0, 4, 2) belongs to a component that is inside out");
  const Surface flipped = check_geometry(surface, true);
  EXPECT_EQ(flipped.positions, surface.positions);
  EXPECT_NEAR(enclosed_volume(*flipped.triangulation, flipped.positions), 4.0 / 3, 1e-14);
  EXPECT_EQ(flipped.triangulation->triangles()[0], octahedron().triangulation->triangles()[0]);
}

TEST(CheckGeometry, FlipsOnlyTheComponentThatIsInsideOut) {
  refuses(two_octahedra(true), "triangle 8 ");
  const Surface flipped = check_geometry(two_octahedra(true), true);
  EXPECT_NEAR(enclosed_volume(*flipped.triangulation, flipped.positions), 8.0 / 3, 1e-13);
  EXPECT_NO_THROW((void)check_geometry(two_octahedra(false), false));
}

}  // namespace
}  // namespace vesica::mesh
