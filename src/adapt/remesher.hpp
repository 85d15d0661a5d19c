#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "editable_mesh.hpp"
#include "fitness.hpp"
#include "vesica/adapt/local_remesh.hpp"
#include "vesica/mesh/surface_locator.hpp"

namespace vesica::adapt {

/// The rounds of local_remesh: a triangulation by corners whose vertices lie on an old surface.
class Remesher {
 public:
  /// Starts from the corners of the old triangulation. Keeps references to both arguments.
  Remesher(const mesh::SurfaceLocator& old, const Eigen::VectorXd& sizes);

  /// Each goes once over all edges and returns how many it changed.
  int split_long_edges();
  int collapse_short_edges();
  int flip_towards_valence_six();
  int flip_for_angles();

  /// Moves each vertex once. Triangles may lose quality down to `enough`.
  void smooth(double enough);

  [[nodiscard]] Remeshed result() const;

 private:
  /// A vertex that takes the place of one or two others.
  struct Substitute {
    std::array<NodeIndex, 2> replaced;
    SurfaceVertex vertex;
  };

  [[nodiscard]] const SurfaceVertex& vertex(NodeIndex v) const {
    return vertices_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] double relative_length(const SurfaceVertex& a, const SurfaceVertex& b) const;
  [[nodiscard]] SurfaceVertex at_place(const mesh::SurfaceLocation& place) const;
  /// Closest point of the old surface on the sheet of `from`.
  [[nodiscard]] mesh::SurfaceLocation closest(const SurfaceVertex& from,
                                              const Eigen::Vector3d& point) const;
  /// Closest point to the middle of the chord.
  [[nodiscard]] mesh::SurfaceLocation middle_of(const SurfaceVertex& a,
                                                const SurfaceVertex& b) const;

  [[nodiscard]] Fitness fitness_of(std::span<const NodeIndex> triangles) const;
  /// With the substitute in place; triangles that have both replaced vertices vanish.
  [[nodiscard]] Fitness fitness_with(std::span<const NodeIndex> triangles,
                                     const Substitute& substitute) const;
  [[nodiscard]] Fitness fitness_flipped(NodeIndex a, NodeIndex b,
                                        const EditableMesh::EdgeSides& sides) const;
  [[nodiscard]] std::vector<mesh::Edge> edges_by_relative_length(double above, double below) const;
  bool try_split(NodeIndex a, NodeIndex b);
  bool try_collapse(NodeIndex a, NodeIndex b);
  [[nodiscard]] bool has_long_edge(NodeIndex a, NodeIndex b, const SurfaceVertex& merged) const;
  [[nodiscard]] Eigen::Vector3d weighted_centroid(NodeIndex v) const;

  const mesh::SurfaceLocator& old_;
  const Eigen::VectorXd& sizes_;
  EditableMesh mesh_;
  std::vector<SurfaceVertex> vertices_;
};

}  // namespace vesica::adapt
