#include "vesica/paper/bisection.hpp"

#include <fmt/format.h>

#include <utility>

#include "bisected_edges.hpp"
#include "bisector.hpp"
#include "mergers.hpp"
#include "vesica/core/error.hpp"

namespace vesica::paper {

Bisected bisect(const mesh::Surface& old, std::span<const Mark> marks) {
  const mesh::NodeIndex num_triangles = old.triangulation->num_triangles();
  if (static_cast<mesh::NodeIndex>(marks.size()) != num_triangles) {
    throw ConfigError(fmt::format("bisection: {} marks: must be one for each of the {} triangles",
                                  marks.size(), num_triangles));
  }
  const BisectedEdges edges = bisected_edges(old, marks);
  const std::vector<Merger> mergers = find_mergers(old, marks, edges);
  constexpr mesh::NodeIndex kept = -1;  // else the number of its parent
  constexpr mesh::NodeIndex gone = -2;
  std::vector<mesh::NodeIndex> fates(marks.size(), kept);
  std::vector<mesh::QuadraticTriangle> parents;
  for (const Merger& merger : mergers) {
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const auto [first, second] = merger.children[pair];
      fates[static_cast<std::size_t>(first)] = static_cast<mesh::NodeIndex>(parents.size());
      fates[static_cast<std::size_t>(second)] = gone;
      parents.push_back(merger.parents[pair]);
    }
  }
  Bisector bisector(old, edges);
  for (mesh::NodeIndex t = 0; t < num_triangles; ++t) {
    const mesh::NodeIndex fate = fates[static_cast<std::size_t>(t)];
    if (fate == kept) bisector.add(t);
    if (fate >= 0) bisector.add_merged(parents[static_cast<std::size_t>(fate)]);
  }
  return {bisector.result(), edges.count, static_cast<int>(mergers.size())};
}

}  // namespace vesica::paper
