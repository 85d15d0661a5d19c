#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "expect_message.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {
namespace {

mesh::Surface cell(ShapeKind kind, double reduced_volume, double radius = 1) {
  ShapeOptions options;
  options.kind = kind;
  options.reduced_volume = reduced_volume;
  options.radius = radius;
  options.resolution = 12;
  return mesh::check_geometry(make_shape(options), false);
}

/// The area is that of flat sub-triangles, 2e-3 too small; the reduced volume then 3e-3 too large.
TEST(CellShapes, HaveTheReducedVolumeAndTheAreaAskedFor) {
  for (const ShapeKind kind : {ShapeKind::discocyte, ShapeKind::stomatocyte}) {
    for (const double wanted : {0.3, 0.6, 0.7, 0.95}) {
      if (kind == ShapeKind::discocyte ? wanted < 0.58 : wanted > 0.72) continue;
      SCOPED_TRACE(testing::Message() << name_of(kind) << " " << wanted);
      const mesh::Surface surface = cell(kind, wanted, 2);
      const std::vector<double> areas =
          mesh::element_areas(*surface.triangulation, surface.positions);
      const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
      const double volume = mesh::enclosed_volume(*surface.triangulation, surface.positions);
      EXPECT_NEAR(area / (16 * std::numbers::pi), 1, 2e-3);
      EXPECT_NEAR(6 * std::sqrt(std::numbers::pi) * volume / std::pow(area, 1.5), wanted, 3e-3);
      EXPECT_GT(mesh::quality(*surface.triangulation, surface.positions), 0.19);
    }
  }
}

TEST(CellShapes, AreConcaveAtOneOrTwoPoles) {
  const auto pole_heights = [](const mesh::Surface& surface) {
    double low = 0;
    double high = 0;
    for (const auto& x : surface.positions.rowwise()) {
      if (x.head<2>().norm() > 1e-9) continue;
      (x[2] < 0 ? low : high) = x[2];
    }
    return std::pair(low, high);
  };
  const mesh::Surface disc = cell(ShapeKind::discocyte, 0.6);
  const auto [bottom, top] = pole_heights(disc);
  EXPECT_NEAR(bottom, -top, 1e-9);
  EXPECT_LT(top, 0.2 * disc.positions.col(2).maxCoeff());
  const mesh::Surface cup = cell(ShapeKind::stomatocyte, 0.6);
  EXPECT_EQ(pole_heights(cup).second, 0);  // both poles lie below the centre of the shell
}

TEST(CellShapes, RefuseReducedVolumesThatTheyCannotHave) {
  test::expect_message<ConfigError>(
      [] { (void)cell(ShapeKind::discocyte, 0.5); },
      "shape.reduced_volume = 0.5: must be between 0.58 and 1 for a discocyte");
  test::expect_message<ConfigError>(
      [] { (void)cell(ShapeKind::stomatocyte, 0.8); },
      "shape.reduced_volume = 0.8: must be between 0.2 and 0.72 for a stomatocyte");
}

}  // namespace
}  // namespace vesica::shapes
