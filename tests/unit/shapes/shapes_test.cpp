#include "vesica/shapes/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "expect_message.hpp"
#include "shape_measures.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::shapes {
namespace {

using test::area_of;
using test::largest_distance;
using test::order;
using test::pi;
using test::quality_of;
using test::shape;
using test::volume_of;

void refuses(const ShapeOptions& options, const std::string& text) {
  test::expect_message<ConfigError>([&] { (void)make_shape(options); }, text);
}

TEST(Shapes, HaveTheExpectedTopologyAndPassTheGeometryCheck) {
  for (const auto kind : {ShapeKind::capsule, ShapeKind::sphere, ShapeKind::ellipsoid,
                          ShapeKind::torus, ShapeKind::peanut, ShapeKind::tips}) {
    for (const auto base : {SphereBase::cube, SphereBase::icosahedron}) {
      for (const int resolution : {3, 4, 7}) {
        const mesh::Surface surface = make_shape(test::shape(kind, resolution, base));
        SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(resolution));
        EXPECT_EQ(surface.triangulation->euler_characteristic(), kind == ShapeKind::torus ? 0 : 2);
        EXPECT_EQ(surface.triangulation->num_components(), 1);
        EXPECT_EQ(surface.positions.rows(), surface.triangulation->num_nodes());
        EXPECT_NO_THROW((void)mesh::check_geometry(surface, false));
      }
    }
  }
}

TEST(Sphere, HasAllNodesAtItsRadius) {
  for (const auto base : {SphereBase::cube, SphereBase::icosahedron}) {
    ShapeOptions options = test::shape(ShapeKind::sphere, 7, base);
    options.radius = 1.7;
    const double distance = test::largest_distance(
        make_shape(options), [](const Eigen::Vector3d& x) { return x.norm() - 1.7; });
    EXPECT_LT(distance, 1e-15 * 4);
  }
}

TEST(Sphere, FromTheCubeKeepsThePapersQualityUnderBisection) {
  for (int bisections = 1; bisections <= 12; ++bisections) {
    const mesh::Surface surface =
        make_shape(test::shape(ShapeKind::sphere, bisections, SphereBase::cube));
    EXPECT_EQ(surface.positions.rows(), 24 * (1 << bisections) + 2);
    EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.498) << bisections;
  }
}

TEST(Sphere, FromTheIcosahedronIsNearlyEquilateralAndUniform) {
  const mesh::Surface surface = make_shape(test::shape(ShapeKind::sphere, 8));
  EXPECT_EQ(surface.positions.rows(), 40 * 64 + 2);
  EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.8);
  EXPECT_LT(mesh::area_ratio(*surface.triangulation, surface.positions), 1.25);
}

TEST(Sphere, ConvergesToItsExactAreaAndVolume) {
  const ShapeOptions options = test::shape(ShapeKind::sphere, 1);
  EXPECT_GT(test::order(area_of, 4 * pi, options, 6, 12), 1.95);
  EXPECT_GT(test::order(volume_of, 4 * pi / 3, options, 6, 12), 3.9);
  // Two bisections halve the edges: errors fall by 4 and 16.
  const auto bisected = [](int n) { return test::shape(ShapeKind::sphere, n, SphereBase::cube); };
  const double area_gain =
      (test::area_of(bisected(6)) - 4 * pi) / (test::area_of(bisected(8)) - 4 * pi);
  const double volume_gain =
      (test::volume_of(bisected(6)) - 4 * pi / 3) / (test::volume_of(bisected(8)) - 4 * pi / 3);
  EXPECT_NEAR(area_gain, 4, 0.1);
  EXPECT_NEAR(volume_gain, 16, 0.8);
}

TEST(Ellipsoid, HasAllNodesOnItAndTheExactVolumeInTheLimit) {
  ShapeOptions options = test::shape(ShapeKind::ellipsoid, 6);
  options.semi_axes = {2, 1, 0.8};
  const double residual = test::largest_distance(make_shape(options), [](const Eigen::Vector3d& x) {
    return x.cwiseQuotient(Eigen::Vector3d(2, 1, 0.8)).norm() - 1;
  });
  EXPECT_LT(residual, 1e-15 * 4);
  EXPECT_GT(test::order(volume_of, 4 * pi / 3 * 1.6, options, 6, 12), 3.9);
  EXPECT_GT(test::quality_of(test::shape(ShapeKind::ellipsoid, 8)), 0.45);
}

TEST(Torus, HasAllNodesOnItAndNearlyEquilateralTriangles) {
  for (const double minor_radius : {0.15, std::sqrt(0.5)}) {
    ShapeOptions options = test::shape(ShapeKind::torus, 12);
    options.minor_radius = minor_radius;
    const mesh::Surface surface = make_shape(options);
    const double distance = test::largest_distance(surface, [&](const Eigen::Vector3d& x) {
      return std::hypot(x.head<2>().norm() - 1, x.z()) - minor_radius;
    });
    EXPECT_LT(distance, 2e-15);
    EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.8);
  }
}

TEST(Torus, ConvergesToItsExactAreaAndVolume) {
  const ShapeOptions options = test::shape(ShapeKind::torus, 1);
  EXPECT_GT(test::order(area_of, 4 * pi * pi * 0.15, options, 8, 16), 1.9);
  EXPECT_GT(test::order(volume_of, 2 * pi * pi * 0.15 * 0.15, options, 8, 16), 3.8);
}

TEST(Peanut, HasTheLengthDiameterAndWaistItWasGiven) {
  ShapeOptions options = test::shape(ShapeKind::peanut, 40);
  options.length = 3;
  options.diameter = 1.2;
  options.waist = 0.7;
  const mesh::Surface surface = make_shape(options);
  const auto radius = [](const Eigen::Vector3d& x) { return std::hypot(x.y() - 0.6, x.z() - 0.6); };
  EXPECT_NEAR(test::largest_distance(surface, radius), 0.6,
              1e-3);  // the widest circle need not be a row
  EXPECT_LE(test::largest_distance(surface, radius), 0.6 + 1e-14);
  EXPECT_NEAR(surface.positions.col(0).minCoeff(), 0, 1e-14);
  EXPECT_NEAR(surface.positions.col(0).maxCoeff(), 3, 1e-14);
  double waist = 1;
  for (Eigen::Index node = 0; node < surface.positions.rows(); ++node) {
    const Eigen::Vector3d x = surface.positions.row(node);
    if (std::abs(x.x() - 1.5) < 0.1) waist = std::min(waist, 2 * radius(x));
  }
  EXPECT_NEAR(waist, 0.7, 1e-12);
}

TEST(Peanut, HasAllNodesOnOneSurfaceOfRevolution) {
  // With rho^2 = (1 - s^2) (w / 2 + b s^2)^2 every node gives the same b.
  const mesh::Surface surface = make_shape(test::shape(ShapeKind::peanut, 6));
  std::vector<double> bulges;
  for (Eigen::Index node = 0; node < surface.positions.rows(); ++node) {
    const Eigen::Vector3d x = surface.positions.row(node);
    const double s = 1 - x.x() / 2;
    if (std::abs(s) < 0.2 || std::abs(s) > 0.98) continue;
    const double rho = std::hypot(x.y() - 0.5, x.z() - 0.5);
    bulges.push_back((rho / std::sqrt(1 - s * s) - 0.25) / (s * s));
  }
  ASSERT_GT(bulges.size(), 1000U);
  const auto [low, high] = std::minmax_element(bulges.begin(), bulges.end());
  EXPECT_GT(*low, 0.3);
  EXPECT_LT(*high - *low, 1e-12);
  EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.5);
}

TEST(Tips, AreLocalMaximaOfTheRadiusInWellSpreadDirections) {
  for (const int number : {1, 2, 3, 4, 6, 12}) {
    ShapeOptions options = test::shape(ShapeKind::tips, 16);
    options.number_of_tips = number;
    options.tip_width = 0.2;
    options.tip_height = 0.2;
    const mesh::Surface surface = make_shape(options);
    const Eigen::VectorXd radii = surface.positions.rowwise().norm();
    EXPECT_NEAR(radii.maxCoeff(), 1.2, 0.01) << number;
    EXPECT_NEAR(radii.minCoeff(), 1.0, 0.01) << number;
    EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.6) << number;
    if (number > 1) {
      // Opposite tips balance: the enclosed bulges have no resultant.
      const Eigen::RowVector3d mean = surface.positions.colwise().mean();
      EXPECT_LT(mean.norm(), 2e-3) << number;
    }
  }
}

TEST(Tips, OfHeightZeroAreASphere) {
  ShapeOptions options = test::shape(ShapeKind::tips, 4);
  options.tip_height = 0;
  const mesh::Surface surface = make_shape(options);
  EXPECT_EQ(surface.positions, make_shape(test::shape(ShapeKind::sphere, 4)).positions);
}

TEST(Shapes, RefuseSizesThatContradictEachOther) {
  ShapeOptions capsule = test::shape(ShapeKind::capsule, 4);
  capsule.diameter = 5;
  refuses(capsule, "shape.diameter = 5: must be <= shape.length = 4");
  ShapeOptions torus = test::shape(ShapeKind::torus, 8);
  torus.minor_radius = 1;
  refuses(torus, "shape.minor_radius = 1: must be < shape.major_radius = 1");
  ShapeOptions peanut = test::shape(ShapeKind::peanut, 4);
  peanut.waist = 1;
  refuses(peanut, "shape.waist = 1: must be < shape.diameter = 1");
}

TEST(Shapes, RefuseValuesOutOfRange) {
  refuses(test::shape(ShapeKind::capsule, 0), "shape.resolution = 0: must be >= 1");
  refuses(test::shape(ShapeKind::torus, 2), "shape.resolution = 2: must be >= 3");
  refuses(test::shape(ShapeKind::sphere, 40, SphereBase::cube), "shape.resolution = 40: makes");
  refuses(test::shape(ShapeKind::capsule, 2000000000), "shape.resolution = 2000000000: makes");
  ShapeOptions options = test::shape(ShapeKind::sphere, 4);
  options.radius = std::numeric_limits<double>::quiet_NaN();
  refuses(options, "shape.radius = nan: must be > 0");
  options = test::shape(ShapeKind::ellipsoid, 4);
  options.semi_axes.y() = -1;
  refuses(options, "shape.semi_axes = [2, -1, 1]: must be > 0");
  options = test::shape(ShapeKind::tips, 4);
  options.number_of_tips = 0;
  refuses(options, "shape.number_of_tips = 0: must be between 1 and 60");
  refuses(test::shape(ShapeKind::file, 4), "shape.path = \"\": must name a file");
}

TEST(Shapes, DoNotReadTheKeysOfOtherKinds) {
  ShapeOptions options = test::shape(ShapeKind::sphere, 2);
  options.diameter = -1;
  EXPECT_NO_THROW((void)make_shape(options));
}

TEST(Shapes, HaveOneDocumentedFieldForEachOption) {
  ShapeOptions options;
  int num_fields = 0;
  ShapeOptions::fields(options, [&](const Field& field, auto&) {
    EXPECT_FALSE(field.name.empty());
    EXPECT_FALSE(field.meaning.empty());
    ++num_fields;
  });
  EXPECT_EQ(num_fields, 18);
  EXPECT_EQ(name_of(ShapeKind::tips), "tips");
  EXPECT_EQ(name_of(SphereBase::cube), "cube");
}

}  // namespace
}  // namespace vesica::shapes
