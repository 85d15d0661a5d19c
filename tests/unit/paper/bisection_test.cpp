#include "vesica/paper/bisection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/mesh/surface_locator.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::paper {
namespace {

mesh::Surface shape(shapes::ShapeKind kind, int resolution) {
  shapes::ShapeOptions options;
  options.kind = kind;
  options.resolution = resolution;
  options.semi_axes << 1.5, 1, 0.8;
  return with_longest_sides_first(shapes::make_shape(options));
}

std::vector<Mark> everywhere(const mesh::Surface& surface, Mark mark) {
  return std::vector<Mark>(surface.triangulation->triangles().size(), mark);
}

Bisected refined(const mesh::Surface& surface) {
  return bisect(surface, everywhere(surface, Mark::refine));
}

/// Marks a share of the triangles, chosen at random, for refinement.
std::vector<Mark> some(const mesh::Surface& surface, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution is_marked(share);
  std::vector<Mark> marks = everywhere(surface, Mark::keep);
  for (Mark& mark : marks) mark = is_marked(random) ? Mark::refine : Mark::keep;
  return marks;
}

/// Coarsens everywhere until nothing is left to undo.
mesh::Surface coarsened(mesh::Surface surface) {
  for (int round = 0; round < 50; ++round) {
    const Bisected found = bisect(surface, everywhere(surface, Mark::coarsen));
    if (!found.is_changed()) return surface;
    surface = found.mesh.surface;
  }
  ADD_FAILURE() << "still coarsening after 50 rounds";
  return surface;
}

double quality_of(const mesh::Surface& surface) {
  return mesh::quality(*surface.triangulation, surface.positions);
}

double volume_of(const mesh::Surface& surface) {
  return mesh::enclosed_volume(*surface.triangulation, surface.positions);
}

/// Positions of the nodes, sorted: what a mesh is made of, whatever its numbers.
std::set<std::array<double, 3>> places_of(const mesh::Surface& surface) {
  std::set<std::array<double, 3>> places;
  for (const auto x : surface.positions.rowwise()) places.insert({x(0), x(1), x(2)});
  return places;
}

class BisectionOfShapes : public ::testing::TestWithParam<shapes::ShapeKind> {};

TEST_P(BisectionOfShapes, KeepsTheSurfaceClosedAndItsTopology) {
  mesh::Surface surface = shape(GetParam(), 3);
  const int characteristic = surface.triangulation->euler_characteristic();
  for (unsigned round = 0; round < 6; ++round) {
    // The constructor of Triangulation refuses what is not closed or does not conform.
    const Bisected found = bisect(surface, some(surface, 0.15, round));
    EXPECT_EQ(found.mesh.surface.triangulation->euler_characteristic(), characteristic);
    EXPECT_EQ(found.mesh.surface.triangulation->num_nodes(),
              surface.triangulation->num_nodes() + 4 * found.num_bisected_edges);
    surface = found.mesh.surface;
  }
  EXPECT_NO_THROW((void)mesh::check_geometry(surface, false));
}

TEST_P(BisectionOfShapes, BisectsEveryMarkedTriangle) {
  const mesh::Surface surface = shape(GetParam(), 3);
  std::vector<Mark> marks = everywhere(surface, Mark::keep);
  marks[5] = Mark::refine;
  const Bisected found = bisect(surface, marks);
  EXPECT_GE(found.num_bisected_edges, 1);
  EXPECT_LT(found.num_bisected_edges, 8);  // the closure stays near
  const auto& old = surface.triangulation->triangles()[5];
  for (const auto& nodes : found.mesh.surface.triangulation->triangles()) {
    const std::array<mesh::NodeIndex, 3> corners{nodes[0], nodes[1], nodes[2]};
    EXPECT_FALSE(std::is_permutation(corners.begin(), corners.end(), old.begin()));
  }
}

TEST_P(BisectionOfShapes, LeavesTheSurfaceItselfAsItIs) {
  const mesh::Surface surface = shape(GetParam(), 4);
  const mesh::SurfaceLocator exact(surface.triangulation, surface.positions);
  mesh::Surface fine = surface;
  for (unsigned round = 0; round < 4; ++round)
    fine = bisect(fine, some(fine, 0.3, round)).mesh.surface;
  EXPECT_GT(fine.triangulation->num_nodes(), 2 * surface.triangulation->num_nodes());
  EXPECT_NEAR(volume_of(fine) / volume_of(surface), 1, 1e-13);
  for (mesh::NodeIndex t = 0; t < fine.triangulation->num_triangles(); ++t) {
    const mesh::SurfaceLocation inside{t, 0.3, 0.2, Eigen::Vector3d::Zero(), 0};
    const Eigen::Vector3d x = mesh::interpolate(*fine.triangulation, inside, fine.positions);
    ASSERT_LT(exact.closest(x).distance, 1e-9);
  }
}

TEST_P(BisectionOfShapes, GivesTheOldNodesBackWhenUndone) {
  const mesh::Surface surface = shape(GetParam(), 3);
  const mesh::Surface start = coarsened(surface);  // a shape may be the refinement of another
  mesh::Surface fine = start;
  for (unsigned round = 0; round < 5; ++round)
    fine = bisect(fine, some(fine, 0.2, round)).mesh.surface;
  const mesh::Surface back = coarsened(fine);
  EXPECT_GT(fine.triangulation->num_nodes(), 2 * start.triangulation->num_nodes());
  EXPECT_EQ(back.triangulation->num_nodes(), start.triangulation->num_nodes());
  EXPECT_EQ(places_of(back), places_of(start));
  EXPECT_EQ(volume_of(back), volume_of(start));
}

INSTANTIATE_TEST_SUITE_P(Shapes, BisectionOfShapes,
                         ::testing::Values(shapes::ShapeKind::sphere, shapes::ShapeKind::torus,
                                           shapes::ShapeKind::capsule,
                                           shapes::ShapeKind::ellipsoid),
                         [](const auto& info) { return std::string(name_of(info.param)); });

TEST(Bisection, CarriesQuadraticFieldsOverExactly) {
  const mesh::Surface old = shape(shapes::ShapeKind::ellipsoid, 3);
  // Any nodal field is quadratic in (u, v): the new mesh must have the same function.
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd field =
      Eigen::VectorXd::NullaryExpr(old.positions.rows(), [&] { return normal(random); });
  const Bisected found = bisect(old, some(old, 0.3, 1));
  const auto& fine = found.mesh.surface;
  const Eigen::VectorXd carried = mesh::interpolate(*old.triangulation, found.mesh.origins, field);
  EXPECT_LT(
      (mesh::interpolate(*old.triangulation, found.mesh.origins, old.positions) - fine.positions)
          .cwiseAbs()
          .maxCoeff(),
      1e-15);
  const mesh::SurfaceLocator on_old(old.triangulation, old.positions);
  for (mesh::NodeIndex t = 0; t < fine.triangulation->num_triangles(); ++t) {
    const mesh::SurfaceLocation inside{t, 0.2, 0.5, Eigen::Vector3d::Zero(), 0};
    const Eigen::Vector3d x = mesh::interpolate(*fine.triangulation, inside, fine.positions);
    const double here = mesh::interpolate(*fine.triangulation, inside, carried).value();
    const double there = mesh::interpolate(*old.triangulation, on_old.closest(x), field).value();
    ASSERT_NEAR(here, there, 1e-8);  // as good as the closest point is
  }
}

TEST(Bisection, CoarsensOnlyWhatIsMarked) {
  const mesh::Surface start = coarsened(shape(shapes::ShapeKind::sphere, 4));
  const mesh::Surface fine = refined(start).mesh.surface;
  std::vector<Mark> marks = everywhere(fine, Mark::keep);
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const auto& nodes = fine.triangulation->triangles()[t];
    if (fine.positions.row(nodes[2]).z() > 0.3) marks[t] = Mark::coarsen;
  }
  const Bisected found = bisect(fine, marks);
  EXPECT_GT(found.num_removed_vertices, 10);
  EXPECT_EQ(found.num_bisected_edges, 0);
  EXPECT_EQ(found.mesh.surface.triangulation->num_nodes(),
            fine.triangulation->num_nodes() - 4 * found.num_removed_vertices);
  const auto old_places = places_of(fine);
  const auto new_places = places_of(found.mesh.surface);
  for (const auto& place : new_places) EXPECT_EQ(old_places.count(place), 1U);
  for (const auto& place : old_places) {
    EXPECT_TRUE(place[2] > -0.2 || new_places.count(place) == 1);
  }
}

TEST(Bisection, DoesNotCoarsenWhereTheMergedTrianglesWouldBeBad) {
  mesh::Surface fine = shape(shapes::ShapeKind::sphere, 4);
  std::vector<Mark> marks = everywhere(fine, Mark::keep);
  marks[0] = Mark::refine;
  fine = bisect(fine, marks).mesh.surface;
  const auto removed = [&] {
    return bisect(fine, everywhere(fine, Mark::coarsen)).num_removed_vertices;
  };
  const auto& triangles = fine.triangulation->triangles();
  const auto child = std::find_if(triangles.begin(), triangles.end(), [&](const auto& nodes) {
    return std::count_if(triangles.begin(), triangles.end(),
                         [&](const auto& other) { return other[2] == nodes[2]; }) == 4;
  });
  ASSERT_NE(child, triangles.end());
  const int num_removed = removed();
  fine.positions.row((*child)[2]) *= 1.6;  // as a mid-edge node it would make spikes
  EXPECT_EQ(removed(), num_removed - 1);
}

TEST(Bisection, KeepsTheQualityOfThePapersSphereOverManyRefinements) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.base = shapes::SphereBase::cube;
  options.resolution = 1;
  mesh::Surface sphere = with_longest_sides_first(shapes::make_shape(options));
  for (int round = 0; round < 10; ++round) {
    sphere = refined(sphere).mesh.surface;
    sphere.positions.rowwise().normalize();
    EXPECT_GT(quality_of(sphere), 0.498) << round;
  }
  EXPECT_EQ(sphere.triangulation->num_nodes(), 24 * (1 << 11) + 2);
}

TEST(Bisection, KeepsTheQualityOfLocalRefinement) {
  mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 3);
  for (int round = 0; round < 16; ++round) {
    std::vector<Mark> marks = everywhere(sphere, Mark::keep);
    for (std::size_t t = 0; t < marks.size(); ++t) {
      const auto& nodes = sphere.triangulation->triangles()[t];
      if ((sphere.positions.row(nodes[4]) - Eigen::RowVector3d(0.6, 0, 0.8)).norm() <
          0.3 / (round + 1))
        marks[t] = Mark::refine;
    }
    sphere = bisect(sphere, marks).mesh.surface;
    sphere.positions.rowwise().normalize();
  }
  EXPECT_GT(quality_of(sphere), 0.35);
}

TEST(Bisection, RefusesAnotherNumberOfMarks) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 1);
  const std::vector<Mark> marks(3, Mark::keep);
  try {
    (void)bisect(sphere, marks);
    ADD_FAILURE() << "nothing thrown";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "bisection: 3 marks: must be one for each of the 20 triangles");
  }
}

}  // namespace
}  // namespace vesica::paper
