#include "vesica/mesh/triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/edges.hpp"

namespace vesica::mesh {
namespace {

using test::expect_message;
using test::octahedron_triangles;
using test::with_edge_nodes;

std::vector<QuadraticTriangle> quadratic_octahedron() {
  return add_edge_nodes(octahedron_triangles(), 6).triangles;
}

/// Eight triangles on the nodes first .. first + 5.
std::vector<Corners> shifted_octahedron(NodeIndex first) {
  std::vector<Corners> triangles = octahedron_triangles();
  for (Corners& corners : triangles) {
    for (NodeIndex& node : corners) node += first;
  }
  return triangles;
}

void refuses(const std::vector<Corners>& triangles, NodeIndex num_vertices,
             const std::string& text) {
  expect_message<ConfigError>([&] { (void)with_edge_nodes(triangles, num_vertices); }, text);
}

void refuses(const std::vector<QuadraticTriangle>& triangles, NodeIndex num_nodes,
             const std::string& text) {
  expect_message<ConfigError>([&] { (void)Triangulation(triangles, num_nodes); }, text);
}

TEST(Triangulation, CountsNodesEdgesAndComponentsOfAnOctahedron) {
  const Triangulation octahedron = with_edge_nodes(octahedron_triangles(), 6);
  EXPECT_EQ(octahedron.num_nodes(), 18);
  EXPECT_EQ(octahedron.num_vertices(), 6);
  EXPECT_EQ(octahedron.num_edges(), 12);
  EXPECT_EQ(octahedron.num_triangles(), 8);
  EXPECT_EQ(octahedron.num_components(), 1);
  EXPECT_EQ(octahedron.euler_characteristic(), 2);
}

TEST(Triangulation, CountsTwoSeparateSurfacesAsTwoComponents) {
  std::vector<Corners> both = octahedron_triangles();
  const std::vector<Corners> other = shifted_octahedron(6);
  both.insert(both.end(), other.begin(), other.end());
  const Triangulation pair = with_edge_nodes(both, 12);
  EXPECT_EQ(pair.num_components(), 2);
  EXPECT_EQ(pair.euler_characteristic(), 4);
}

TEST(Triangulation, GivesBothTrianglesOfAnEdgeTheSameMidEdgeNode) {
  const QuadraticConnectivity connectivity = add_edge_nodes(octahedron_triangles(), 6);
  for (const QuadraticTriangle& nodes : connectivity.triangles) {
    for (std::size_t side = 0; side < 3; ++side) {
      const Edge& edge = connectivity.edges[static_cast<std::size_t>(nodes[3 + side] - 6)];
      EXPECT_EQ(edge[0], std::min(nodes[side], nodes[(side + 1) % 3]));
      EXPECT_EQ(edge[1], std::max(nodes[side], nodes[(side + 1) % 3]));
    }
  }
}

TEST(Triangulation, RefusesAnOpenSurfaceAndNamesTheFirstOpenEdge) {
  std::vector<Corners> triangles = octahedron_triangles();
  triangles.pop_back();
  refuses(triangles, 6,
          "triangulation: edge (0, 3) belongs to 1 triangle (3): the surface must be closed");
}

TEST(Triangulation, RefusesAnEmptyList) {
  refuses(std::vector<QuadraticTriangle>{}, 0, "triangulation: no triangles");
}

TEST(Triangulation, RefusesAnEdgeOfMoreThanTwoTriangles) {
  // Two tetrahedra that share the edge (0, 1).
  const std::vector<Corners> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                          {0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {4, 0, 5}};
  refuses(triangles, 6, "edge (0, 1) belongs to 4 triangles: the surface must be manifold");
}

TEST(Triangulation, RefusesATriangleTurnedAgainstItsNeighbours) {
  std::vector<Corners> triangles = octahedron_triangles();
  std::swap(triangles[2][0], triangles[2][1]);
  refuses(triangles, 6, "edge (1, 3): triangles 2 and 6 are oriented inconsistently");
}

TEST(Triangulation, RefusesTwoSurfacesThatMeetAtOneVertex) {
  std::vector<Corners> both = octahedron_triangles();
  for (Corners corners : shifted_octahedron(6)) {
    for (NodeIndex& node : corners) node = node == 6 ? 0 : node - 1;
    both.push_back(corners);
  }
  refuses(both, 11, "node 0: triangles 0 and 8 meet only there");
}

TEST(Triangulation, RefusesTrianglesThatDisagreeOnTheMidEdgeNode) {
  std::vector<QuadraticTriangle> triangles = quadratic_octahedron();
  const NodeIndex right = triangles[0][3];
  triangles[0][3] = 18;
  refuses(triangles, 19,
          "edge (0, 2): triangles 0 and 4 disagree on its mid-edge node (18 and " +
              std::to_string(right) + ")");
}

TEST(Triangulation, RefusesOneMidEdgeNodeForTwoEdges) {
  std::vector<QuadraticTriangle> triangles = quadratic_octahedron();
  const NodeIndex of_0_2 = triangles[0][3];
  const NodeIndex of_1_3 = triangles[2][3];
  for (QuadraticTriangle& nodes : triangles)
    std::replace(nodes.begin(), nodes.end(), of_1_3, of_0_2);
  refuses(triangles, 18, "edge (1, 3): its mid-edge node 6 belongs to another edge");
}

TEST(Triangulation, RefusesACornerAsMidEdgeNode) {
  std::vector<QuadraticTriangle> triangles = quadratic_octahedron();
  const NodeIndex of_0_2 = triangles[0][3];
  for (QuadraticTriangle& nodes : triangles) {
    std::replace(nodes.begin(), nodes.end(), of_0_2, NodeIndex{1});
  }
  refuses(triangles, 18, "edge (0, 2): its mid-edge node 1 is a corner");
}

TEST(Triangulation, RefusesUnusedOutOfRangeAndRepeatedNodes) {
  std::vector<QuadraticTriangle> triangles = quadratic_octahedron();
  refuses(triangles, 19, "node 18 is in no triangle");
  refuses(triangles, 17, "has node 17: must be in [0, 17)");
  triangles[5][1] = triangles[5][0];
  refuses(triangles, 18, "triangle 5 repeats node 1");
  refuses(std::vector<Corners>{{0, 1, -2}}, 3, "triangle 0 has node -2: must be in [0, 3)");
}

}  // namespace
}  // namespace vesica::mesh
