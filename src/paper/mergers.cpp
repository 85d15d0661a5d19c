#include "mergers.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "adapt/editable_mesh.hpp"
#include "vesica/mesh/local_nodes.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::paper {
namespace {

/// Quality that a merged triangle may have even if its children were better.
constexpr double fair_quality = 0.3;

double quality_of(const mesh::Positions& x, const mesh::QuadraticTriangle& nodes) {
  double quality = 1;
  for (const auto& local : mesh::sub_triangles)
    quality = std::min(quality, mesh::smallest_sine(mesh::sub_triangle(nodes, local, x)));
  return quality;
}

Eigen::Vector3d normal_of(const mesh::Positions& x, const mesh::QuadraticTriangle& nodes,
                          const std::array<std::size_t, 3>& local) {
  return mesh::area_vector(mesh::sub_triangle(nodes, local, x));
}

/// The parent of two neighbours with the same newest vertex, its own newest vertex last.
std::optional<mesh::QuadraticTriangle> parent_of(const mesh::QuadraticTriangle& one,
                                                 const mesh::QuadraticTriangle& other) {
  if (other[1] == one[0])
    return mesh::QuadraticTriangle{one[1], other[0], one[0], one[2], other[3], one[3]};
  if (one[1] == other[0]) return parent_of(other, one);
  return std::nullopt;
}

/// Finds mergers one after the other, with what earlier ones have changed.
class MergerFinder {
 public:
  MergerFinder(const mesh::Surface& surface, std::span<const Mark> marks,
               const BisectedEdges& edges)
      : surface_(surface), marks_(marks), edges_(edges), mesh_(*surface.triangulation) {
    valences_.reserve(static_cast<std::size_t>(mesh_.num_vertices()));
    for (mesh::NodeIndex v = 0; v < mesh_.num_vertices(); ++v)
      valences_.push_back(mesh_.valence(v));
  }

  [[nodiscard]] std::vector<Merger> find() {
    std::vector<Merger> found;
    for (mesh::NodeIndex v = 0; v < mesh_.num_vertices(); ++v) {
      if (const auto merger = candidate(v); merger && try_add(*merger)) found.push_back(*merger);
    }
    return found;
  }

 private:
  const mesh::QuadraticTriangle& triangle(mesh::NodeIndex t) const {
    return surface_.triangulation->triangles()[static_cast<std::size_t>(t)];
  }

  [[nodiscard]] bool may_go(mesh::NodeIndex t) const {
    const auto is_bisected = [&](mesh::NodeIndex middle) {
      return edges_.has_node[static_cast<std::size_t>(middle)];
    };
    const mesh::QuadraticTriangle& nodes = triangle(t);
    return marks_[static_cast<std::size_t>(t)] == Mark::coarsen && !is_bisected(nodes[3]) &&
           !is_bisected(nodes[4]) && !is_bisected(nodes[5]);
  }

  [[nodiscard]] std::optional<Merger> candidate(mesh::NodeIndex v) const {
    if (mesh_.valence(v) != 4) return std::nullopt;
    std::array<mesh::NodeIndex, 4> star{};
    std::copy(mesh_.star(v).begin(), mesh_.star(v).end(), star.begin());
    std::sort(star.begin(), star.end());  // children of one parent follow each other
    for (const mesh::NodeIndex t : star) {
      if (triangle(t)[2] != v || !may_go(t)) return std::nullopt;
    }
    const auto first = parent_of(triangle(star[0]), triangle(star[1]));
    const auto second = parent_of(triangle(star[2]), triangle(star[3]));
    if (!first || !second) return std::nullopt;
    const Merger merger{{{{star[0], star[1]}, {star[2], star[3]}}}, {*first, *second}};
    return is_fit(merger, 0) && is_fit(merger, 1) ? std::optional(merger) : std::nullopt;
  }

  [[nodiscard]] bool is_fit(const Merger& merger, std::size_t pair) const {
    const mesh::Positions& x = surface_.positions;
    const mesh::QuadraticTriangle& parent = merger.parents[pair];
    double present = 1;
    const Eigen::Vector3d normal = normal_of(x, parent, {0, 1, 2});
    for (const mesh::NodeIndex t : merger.children[pair]) {
      present = std::min(present, quality_of(x, triangle(t)));
      if (normal_of(x, triangle(t), {0, 1, 2}).dot(normal) <= 0) return false;
    }
    for (const auto& local : mesh::sub_triangles) {
      if (normal_of(x, parent, local).dot(normal) <= 0) return false;
    }
    return quality_of(x, parent) >= std::min(present, fair_quality);
  }

  bool try_add(const Merger& merger) {
    const mesh::NodeIndex a = merger.parents[0][0];
    const mesh::NodeIndex b = merger.parents[0][1];
    const mesh::NodeIndex left = merger.parents[0][2];
    const mesh::NodeIndex right = merger.parents[1][2];
    int& valence_left = valences_[static_cast<std::size_t>(left)];
    int& valence_right = valences_[static_cast<std::size_t>(right)];
    if (left == right || valence_left <= 3 || valence_right <= 3 || mesh_.sides(a, b)) return false;
    const auto [low, high] = std::minmax(a, b);
    if (!new_edges_.insert({low, high}).second) return false;
    --valence_left;
    --valence_right;
    return true;
  }

  const mesh::Surface& surface_;
  std::span<const Mark> marks_;
  const BisectedEdges& edges_;
  adapt::EditableMesh mesh_;
  std::vector<int> valences_;
  std::set<mesh::Edge> new_edges_;
};

}  // namespace

std::vector<Merger> find_mergers(const mesh::Surface& surface, std::span<const Mark> marks,
                                 const BisectedEdges& edges) {
  return MergerFinder(surface, marks, edges).find();
}

}  // namespace vesica::paper
