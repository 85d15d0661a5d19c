#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/surface_file.hpp"

namespace vesica::shapes {
namespace {

/// Points and triangles of a file, at first an octahedron.
struct Polygons {
  std::vector<Eigen::Vector3d> points;
  std::vector<mesh::Corners> triangles = test::octahedron_triangles();
  Polygons() {
    const mesh::Positions vertices = test::octahedron_vertices();
    for (const auto& row : vertices.rowwise()) points.emplace_back(row);
  }
};

class Repair : public testing::Test {
 protected:
  [[nodiscard]] std::string write(const Polygons& polygons) const {
    std::string text =
        fmt::format("OFF\n{} {}\n", polygons.points.size(), polygons.triangles.size());
    for (const Eigen::Vector3d& x : polygons.points)
      text += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
    for (const auto& [a, b, c] : polygons.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
    std::ofstream(path()) << text;
    return path();
  }
  [[nodiscard]] std::string path() const { return (temporary_.path() / "s.off").string(); }

  /// The octahedron with outward normals, and these notes.
  void mends(const Polygons& polygons, const std::vector<std::string>& notes) const {
    const Shape shape = read_shape(write(polygons), {.repairs = true});
    EXPECT_EQ(shape.surface.triangulation->num_vertices(), 6);
    EXPECT_EQ(shape.surface.triangulation->num_triangles(), 8);
    EXPECT_GT(mesh::enclosed_volume(*shape.surface.triangulation, shape.surface.positions),
              4.0 / 3);
    ASSERT_EQ(shape.notes.size(), notes.size());
    for (std::size_t i = 0; i < notes.size(); ++i)
      EXPECT_EQ(shape.notes[i], "shape.repair: " + path() + ": " + notes[i]);
  }
  void refuses(const Polygons& polygons, const std::string& message) const {
    const std::string file = write(polygons);
    test::expect_message<ConfigError>([&] { (void)read_shape(file); }, message);
  }

  test::TemporaryFolder temporary_;
};

TEST_F(Repair, LeavesASoundSurfaceAsItIs) {
  mends({}, {});
  const Shape repaired = read_shape(path(), {.repairs = true});
  const Shape plain = read_shape(path());
  EXPECT_EQ(repaired.surface.positions, plain.surface.positions);
  EXPECT_TRUE(std::ranges::equal(repaired.surface.triangulation->triangles(),
                                 plain.surface.triangulation->triangles()));
}

TEST_F(Repair, TurnsTrianglesThatRunTheOtherWayRound) {
  Polygons mixed;
  for (const std::size_t t : {0U, 3U, 4U}) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  mends(mixed, {"3 of 8 triangles turned"});
  refuses(mixed,
          "oriented inconsistently (nodes and triangles counted from 0); shape.repair = true mends "
          "this surface: 3 of 8 triangles turned");
  Polygons inside_out;
  for (auto& corners : inside_out.triangles) std::swap(corners[0], corners[1]);
  mends(inside_out, {"8 of 8 triangles turned"});
}

TEST_F(Repair, MergesVerticesAtTheSamePlace) {
  Polygons soup;
  soup.points.clear();
  for (auto& corners : soup.triangles) {
    for (mesh::NodeIndex& corner : corners) {
      const Eigen::Vector3d point = test::octahedron_vertices().row(corner);
      corner = static_cast<mesh::NodeIndex>(soup.points.size());
      soup.points.push_back(point * (1 + 1e-8 * corner));  // as rounded numbers may differ
    }
  }
  mends(soup, {"18 of 24 vertices merged with others at the same place"});
  refuses(
      soup,
      "the surface must be closed (nodes and triangles counted from 0); nodes 1 and 3 coincide, "
      "and so do 17 other pairs; shape.repair = true mends this surface: 18 of 24");
}

TEST_F(Repair, DropsWhatNoSurfaceNeeds) {
  Polygons more;
  more.points.emplace_back(5, 5, 5);                 // unused
  more.points.emplace_back(1, 0, 0);                 // node 0 again,
  more.triangles.push_back({0, 7, 2});               // with a triangle without area
  more.triangles.push_back(more.triangles.front());  // twice the same
  mends(more, {"1 of 8 vertices merged with others at the same place",
               "2 of 10 triangles dropped that repeat a corner or another triangle",
               "1 of 7 vertices dropped that no triangle uses"});
}

TEST_F(Repair, KeepsTheLargestOfSeveralParts) {
  Polygons two;
  for (int i = 0; i < 6; ++i)
    two.points.push_back(0.5 * two.points[static_cast<std::size_t>(i)] + Eigen::Vector3d(3, 0, 0));
  for (int t = 0; t < 8; ++t) {
    auto corners = two.triangles[static_cast<std::size_t>(t)];
    for (mesh::NodeIndex& corner : corners) corner += 6;
    two.triangles.push_back(corners);
  }
  mends(two, {"the largest of 2 parts kept, 8 of 16 triangles",
              "6 of 12 vertices dropped that no triangle uses"});
}

TEST_F(Repair, DoesNotCloseHolesAndPromisesNothingThen) {
  Polygons open;
  open.triangles.pop_back();
  const std::string file = write(open);
  for (const bool repairs : {false, true}) {
    try {
      (void)read_shape(file, {.repairs = repairs});
      ADD_FAILURE() << "accepted";
    } catch (const ConfigError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("the surface must be closed"), std::string::npos) << message;
      EXPECT_EQ(message.find("shape.repair"), std::string::npos) << message;
    }
  }
}

/// A unit sphere whose vertices are moved along the normal by +-5 % of an edge.
TEST_F(Repair, SmoothingTakesRoughnessAwayAndNearlyKeepsTheVolume) {
  ShapeOptions options;
  options.kind = ShapeKind::sphere;
  options.resolution = 8;
  const mesh::Surface sphere = make_shape(options);
  Polygons rough;
  rough.points.clear();
  rough.triangles.clear();
  unsigned random = 1;
  for (mesh::NodeIndex i = 0; i < sphere.triangulation->num_vertices(); ++i) {
    random = random * 1664525U + 1013904223U;
    const double part = static_cast<double>(random >> 8) / (1U << 24);
    rough.points.emplace_back((1 + 0.015 * (part - 0.5)) * sphere.positions.row(i).transpose());
  }
  for (const auto& nodes : sphere.triangulation->triangles())
    rough.triangles.push_back({nodes[0], nodes[1], nodes[2]});
  const auto roughness = [&](int passes) {
    const Shape shape = read_shape(write(rough), {.smoothing = passes});
    const Eigen::VectorXd radii = shape.surface.positions.rowwise().norm();
    EXPECT_NEAR(radii.mean(), 1, 5e-3);
    return std::sqrt((radii.array() - radii.mean()).square().mean());
  };
  EXPECT_LT(roughness(10), 0.6 * roughness(0));
}

}  // namespace
}  // namespace vesica::shapes
