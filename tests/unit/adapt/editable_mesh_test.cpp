#include "adapt/editable_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "vesica/mesh/edges.hpp"

namespace vesica::adapt {
namespace {

/// Octahedron with vertices +x, -x, +y, -y, +z, -z.
EditableMesh octahedron() {
  return {{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
          6};
}

/// Checks the mesh with the rules of Triangulation (closed, oriented, one fan a vertex), and that
/// the stars agree with the triangles. Returns the Euler characteristic.
int checked_characteristic(const EditableMesh& mesh) {
  std::vector<mesh::NodeIndex> number(static_cast<std::size_t>(mesh.num_vertices()), -1);
  mesh::NodeIndex num_vertices = 0;
  std::size_t sum_of_valences = 0;
  for (mesh::NodeIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.star(v).empty()) continue;
    number[static_cast<std::size_t>(v)] = num_vertices++;
    sum_of_valences += mesh.star(v).size();
    for (const mesh::NodeIndex t : mesh.star(v)) {
      const auto& corners = mesh.corners(t);
      EXPECT_EQ(std::count(corners.begin(), corners.end(), v), 1);
    }
  }
  auto triangles = mesh.triangles();
  EXPECT_EQ(sum_of_valences, 3 * triangles.size());
  for (auto& corners : triangles) {
    for (auto& v : corners) v = number[static_cast<std::size_t>(v)];
  }
  auto connectivity = mesh::add_edge_nodes(triangles, num_vertices);
  EXPECT_EQ(connectivity.edges.size(), mesh.edges().size());
  const auto num_nodes = num_vertices + static_cast<mesh::NodeIndex>(connectivity.edges.size());
  return mesh::Triangulation(std::move(connectivity.triangles), num_nodes).euler_characteristic();
}

TEST(EditableMesh, KnowsBothSidesOfAnEdge) {
  const auto sides = octahedron().sides(0, 2);
  ASSERT_TRUE(sides);
  EXPECT_EQ(sides->triangles, (std::array<mesh::NodeIndex, 2>{0, 4}));
  EXPECT_EQ(sides->opposite, (std::array<mesh::NodeIndex, 2>{4, 5}));
  EXPECT_FALSE(octahedron().sides(0, 1));
}

TEST(EditableMesh, SplitsAnEdge) {
  EditableMesh mesh = octahedron();
  const mesh::NodeIndex middle = mesh.split(0, 2);
  EXPECT_EQ(mesh.valence(middle), 4);
  EXPECT_EQ(mesh.valence(4), 5);
  EXPECT_FALSE(mesh.sides(0, 2));
  EXPECT_EQ(mesh.triangles().size(), 10U);
  EXPECT_EQ(checked_characteristic(mesh), 2);
}

TEST(EditableMesh, CollapsesAnEdge) {
  EditableMesh mesh = octahedron();
  ASSERT_TRUE(mesh.can_collapse(0, 2));
  mesh.collapse(0, 2);
  EXPECT_TRUE(mesh.star(2).empty());
  EXPECT_EQ(mesh.triangles().size(), 6U);
  EXPECT_EQ(checked_characteristic(mesh), 2);
}

TEST(EditableMesh, FlipsAnEdge) {
  EditableMesh mesh = octahedron();
  ASSERT_TRUE(mesh.can_flip(0, 2));
  mesh.flip(0, 2);
  EXPECT_TRUE(mesh.sides(4, 5));
  EXPECT_FALSE(mesh.sides(0, 2));
  EXPECT_EQ(mesh.valence(0), 3);
  EXPECT_EQ(checked_characteristic(mesh), 2);
}

TEST(EditableMesh, RefusesToFlipIntoAnEdgeThatExists) {
  EditableMesh mesh = octahedron();
  mesh.flip(0, 2);
  EXPECT_FALSE(mesh.can_flip(0, 4));  // valence 3 at 0
  EXPECT_FALSE(mesh.can_flip(0, 3));  // 4 and 5 are joined already
}

TEST(EditableMesh, RefusesACollapseThatWouldPinchTheSurface) {
  // Two triangular tubes' worth of a torus-like ring: 3 x 3 vertices, every edge closes a loop of
  // three edges that bounds no triangle.
  std::vector<mesh::Corners> triangles;
  const auto at = [](int i, int j) { return static_cast<mesh::NodeIndex>(3 * (i % 3) + j % 3); };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const EditableMesh torus(triangles, 9);
  EXPECT_EQ(checked_characteristic(torus), 0);
  for (const auto& [a, b] : torus.edges()) EXPECT_FALSE(torus.can_collapse(a, b));
}

TEST(EditableMesh, EndsCollapsingAtATetrahedron) {
  EditableMesh mesh = octahedron();
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : mesh.edges()) {
      if (!mesh.can_collapse(a, b)) continue;
      mesh.collapse(a, b);
      changed = true;
      break;
    }
  }
  EXPECT_EQ(mesh.triangles().size(), 4U);
  EXPECT_EQ(checked_characteristic(mesh), 2);
}

}  // namespace
}  // namespace vesica::adapt
