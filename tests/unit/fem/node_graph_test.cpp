#include "vesica/fem/node_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "relaxation_cases.hpp"

namespace vesica::fem {
namespace {

class NodeGraphTest : public ::testing::Test {
 protected:
  mesh::Surface sphere_ = test::make_sphere(2);
  NodeGraph graph_{*sphere_.triangulation};

  [[nodiscard]] const mesh::QuadraticTriangle& triangle(int t) const {
    return sphere_.triangulation->triangles()[static_cast<std::size_t>(t)];
  }
};

TEST_F(NodeGraphTest, JoinsExactlyTheNodesThatShareATriangle) {
  std::vector<std::set<std::int32_t>> expected(
      static_cast<std::size_t>(sphere_.triangulation->num_nodes()));
  for (const auto& triangle : sphere_.triangulation->triangles()) {
    for (const auto i : triangle) {
      for (const auto j : triangle) expected[static_cast<std::size_t>(i)].insert(j);
    }
  }
  ASSERT_EQ(graph_.num_nodes(), sphere_.triangulation->num_nodes());
  std::int64_t pairs = 0;
  for (std::int32_t node = 0; node < graph_.num_nodes(); ++node) {
    const auto neighbours = graph_.neighbours(node);
    EXPECT_TRUE(std::is_sorted(neighbours.begin(), neighbours.end()));
    const std::set<std::int32_t> found(neighbours.begin(), neighbours.end());
    EXPECT_EQ(found, expected[static_cast<std::size_t>(node)]);
    EXPECT_EQ(found.size(), neighbours.size());
    EXPECT_EQ(graph_.first_pair(node), pairs);
    pairs += static_cast<std::int64_t>(neighbours.size());
  }
  EXPECT_EQ(graph_.num_pairs(), pairs);
}

TEST_F(NodeGraphTest, NamesEveryCornerOfEveryTriangleOnceAtItsNode) {
  std::set<std::int32_t> codes;
  for (std::int32_t node = 0; node < graph_.num_nodes(); ++node) {
    for (const auto code : graph_.incidences(node)) {
      EXPECT_EQ(triangle(code / 6)[static_cast<std::size_t>(code % 6)], node);
      EXPECT_TRUE(codes.insert(code).second);
    }
  }
  EXPECT_EQ(codes.size(), static_cast<std::size_t>(sphere_.triangulation->num_triangles()) * 6);
}

TEST_F(NodeGraphTest, NamesEveryLocalMatrixEntryOnceAtItsPairOfNodes) {
  std::set<std::int32_t> codes;
  for (std::int32_t node = 0; node < graph_.num_nodes(); ++node) {
    auto pair = graph_.first_pair(node);
    for (const auto neighbour : graph_.neighbours(node)) {
      for (const auto code : graph_.contributions(pair)) {
        const auto& corners = triangle(code / 36);
        EXPECT_EQ(corners[static_cast<std::size_t>(code % 36 / 6)], node);
        EXPECT_EQ(corners[static_cast<std::size_t>(code % 6)], neighbour);
        EXPECT_TRUE(codes.insert(code).second);
      }
      ++pair;
    }
  }
  EXPECT_EQ(codes.size(), static_cast<std::size_t>(sphere_.triangulation->num_triangles()) * 36);
}

TEST_F(NodeGraphTest, MakesABlockPatternWithDenseBlocksAndAscendingRows) {
  const auto matrix = graph_.block_pattern(3);
  EXPECT_EQ(matrix.size, 3 * graph_.num_nodes());
  EXPECT_EQ(matrix.num_nonzeros(), 9 * graph_.num_pairs());
  for (std::size_t column = 0; column < static_cast<std::size_t>(matrix.size); ++column) {
    const std::vector<linalg::SparseIndex> rows(
        matrix.rows.begin() + matrix.column_starts[column],
        matrix.rows.begin() + matrix.column_starts[column + 1]);
    std::vector<linalg::SparseIndex> expected;
    for (const auto neighbour : graph_.neighbours(static_cast<std::int32_t>(column / 3))) {
      for (int k = 0; k < 3; ++k) expected.push_back(3 * neighbour + k);
    }
    EXPECT_EQ(rows, expected);
  }
}

}  // namespace
}  // namespace vesica::fem
