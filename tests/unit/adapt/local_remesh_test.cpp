#include "vesica/adapt/local_remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "observed_order.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/mesh/surface_locator.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::adapt {
namespace {

using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

mesh::Surface shape(shapes::ShapeKind kind, int resolution) {
  shapes::ShapeOptions options;
  options.kind = kind;
  options.resolution = resolution;
  options.semi_axes << 1.5, 1, 0.8;
  return shapes::make_shape(options);
}

template <class Size>
Eigen::VectorXd sizes_on(const mesh::Surface& surface, Size size) {
  Eigen::VectorXd sizes(surface.positions.rows());
  for (Eigen::Index i = 0; i < sizes.size(); ++i) sizes[i] = size(surface.positions.row(i));
  return sizes;
}

Remeshed uniform(const mesh::Surface& surface, double size) {
  return local_remesh(surface, sizes_on(surface, [&](const Vector3d&) { return size; }));
}

double quality_of(const mesh::Surface& surface) {
  return mesh::quality(*surface.triangulation, surface.positions);
}

/// Lengths of all edges over the size wanted in their middle, sorted.
template <class Size>
std::vector<double> relative_edges(const mesh::Surface& surface, Size size) {
  std::vector<double> lengths;
  for (const auto& nodes : surface.triangulation->triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d a = surface.positions.row(nodes[i]);
      const Vector3d b = surface.positions.row(nodes[(i + 1) % 3]);
      lengths.push_back((b - a).norm() / size(surface.positions.row(nodes[3 + i])));
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

template <class Size>
void expect_good_mesh(const mesh::Surface& old, const Remeshed& found, Size size) {
  const auto& triangulation = *found.surface.triangulation;
  EXPECT_EQ(triangulation.euler_characteristic(), old.triangulation->euler_characteristic());
  EXPECT_EQ(triangulation.num_components(), old.triangulation->num_components());
  EXPECT_GT(quality_of(found.surface), 0.5);
  EXPECT_NO_THROW((void)mesh::check_geometry(found.surface, false));
  const std::vector<double> edges = relative_edges(found.surface, size);
  EXPECT_GT(edges.front(), 0.55);
  EXPECT_LT(edges.back(), 1.6);
  // Edges between 0.72 and 1.36 may stay: a mesh that is nearly right keeps its mean length.
  EXPECT_NEAR(edges[edges.size() / 2], 1.0, 0.15);
}

TEST(LocalRemesh, RefinesAndCoarsensASphere) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 6);  // edges about 0.18
  for (const double size : {0.1, 0.18, 0.35}) {
    SCOPED_TRACE(size);
    const Remeshed found = uniform(sphere, size);
    expect_good_mesh(sphere, found, [&](const Vector3d&) { return size; });
    const double wanted = 8 / std::sqrt(3.0) * 4 * pi / (size * size);
    EXPECT_NEAR(found.surface.triangulation->num_nodes() / wanted, 1.0, 0.25);
  }
}

TEST(LocalRemesh, MeshesATorusAndACapsuleWithGradedSizes) {
  const mesh::Surface torus = shape(shapes::ShapeKind::torus, 8);
  const auto left = [](const Vector3d& x) { return 0.05 + 0.04 * std::abs(x.x() + 1); };
  expect_good_mesh(torus, local_remesh(torus, sizes_on(torus, left)), left);
  const mesh::Surface capsule = shape(shapes::ShapeKind::capsule, 6);
  const auto band = [](const Vector3d& x) {
    return std::min(0.3, 0.08 + 0.2 * std::abs(x.x() - 2));
  };
  expect_good_mesh(capsule, local_remesh(capsule, sizes_on(capsule, band)), band);
}

TEST(LocalRemesh, MeshesAThinNeck) {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::peanut;
  options.waist = 0.1;
  const mesh::Surface peanut = shapes::make_shape(options);
  const auto size = [](const Vector3d& x) {
    return std::min(0.25, 0.025 + 0.2 * std::abs(x.x() - 2));
  };
  expect_good_mesh(peanut, local_remesh(peanut, sizes_on(peanut, size)), size);
}

TEST(LocalRemesh, HealsABadMesh) {
  mesh::Surface surface = shape(shapes::ShapeKind::sphere, 6);
  for (auto x : surface.positions.rowwise()) {  // nodes pressed towards the plane x = y
    x(0) += 0.9 * x(1);
    x.normalize();
  }
  ASSERT_LT(quality_of(surface), 0.45);
  EXPECT_GT(quality_of(uniform(surface, 0.15).surface), 0.55);
}

TEST(LocalRemesh, MeshesARoughSurface) {
  mesh::Surface surface = shape(shapes::ShapeKind::sphere, 6);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.006);  // a fifteenth of the distance of nodes
  for (double& coordinate : surface.positions.reshaped()) coordinate += noise(random);
  ASSERT_LT(mesh::smallest_normal_cosine(*surface.triangulation, surface.positions), 0.9);
  for (const double size : {0.1, 0.3}) EXPECT_GT(quality_of(uniform(surface, size).surface), 0.5);
}

TEST(LocalRemesh, PutsEveryNodeOnTheOldSurface) {
  const mesh::Surface old = shape(shapes::ShapeKind::ellipsoid, 4);
  const Remeshed found = uniform(old, 0.15);
  const mesh::Positions at_origins =
      mesh::interpolate(*old.triangulation, found.origins, old.positions);
  EXPECT_LT((at_origins - found.surface.positions).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(LocalRemesh, KeepsVolumeAndAreaToTheOrderOfInterpolation) {
  const mesh::Surface old = shape(shapes::ShapeKind::sphere, 20);
  const double volume = mesh::enclosed_volume(*old.triangulation, old.positions);
  const auto volume_error = [&](double size) {
    const Remeshed found = uniform(old, size);
    return mesh::enclosed_volume(*found.surface.triangulation, found.surface.positions) - volume;
  };
  const double coarse = volume_error(0.4);
  const double fine = volume_error(0.2);
  EXPECT_GT(test::observed_order(coarse, fine, 2), 3.5);
  EXPECT_LT(std::abs(fine), 1e-3);
}

TEST(LocalRemesh, KeepsTheShapeToTheOrderOfInterpolation) {
  const mesh::Surface old = shape(shapes::ShapeKind::ellipsoid, 20);
  const mesh::SurfaceLocator exact(old.triangulation, old.positions);
  const auto distance = [&](double size) {
    const Remeshed found = uniform(old, size);
    double largest = 0;
    for (mesh::NodeIndex t = 0; t < found.surface.triangulation->num_triangles(); ++t) {
      const mesh::SurfaceLocation inside{t, 0.25, 0.25, Vector3d::Zero(), 0};
      const Vector3d x =
          mesh::interpolate(*found.surface.triangulation, inside, found.surface.positions);
      largest = std::max(largest, exact.closest(x).distance);
    }
    return largest;
  };
  EXPECT_GT(test::observed_order(distance(0.3), distance(0.15), 2), 2.7);
}

TEST(LocalRemesh, LeavesNoLessThanAClosedSurface) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 3);
  const Remeshed found = uniform(sphere, 100);
  EXPECT_EQ(found.surface.triangulation->euler_characteristic(), 2);
  EXPECT_LT(found.surface.triangulation->num_triangles(), 21);
  EXPECT_GT(mesh::smallest_normal_cosine(*found.surface.triangulation, found.surface.positions), 0);
}

TEST(LocalRemesh, KeepsTheHoleOfATorusThatIsMeshedTooCoarsely) {
  const mesh::Surface torus = shape(shapes::ShapeKind::torus, 8);
  const Remeshed found = uniform(torus, 3);
  EXPECT_EQ(found.surface.triangulation->euler_characteristic(), 0);
}

TEST(LocalRemesh, DoesTheSameTwice) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 4);
  EXPECT_EQ(uniform(sphere, 0.2).surface.positions, uniform(sphere, 0.2).surface.positions);
}

void expect_refusal(const mesh::Surface& surface, const Eigen::VectorXd& sizes,
                    const std::string& text) {
  try {
    (void)local_remesh(surface, sizes);
    ADD_FAILURE() << "nothing thrown; expected: " << text;
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()), text);
  }
}

TEST(LocalRemesh, RefusesSizesThatAreTooFewOrNotPositive) {
  const mesh::Surface sphere = shape(shapes::ShapeKind::sphere, 1);
  expect_refusal(sphere, Eigen::VectorXd::Ones(3),
                 "remeshing: 3 sizes: must be one for each of the 42 nodes");
  Eigen::VectorXd sizes = Eigen::VectorXd::Ones(42);
  sizes[5] = -1;
  expect_refusal(sphere, sizes, "remeshing: size -1 at node 5: must be > 0 and finite");
  sizes[5] = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(sphere, sizes, "remeshing: size nan at node 5: must be > 0 and finite");
}

}  // namespace
}  // namespace vesica::adapt
