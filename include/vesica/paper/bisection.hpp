#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "vesica/adapt/remeshed.hpp"
#include "vesica/adapt/size_field.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::paper {

/// The marking strategy (N_in, N_off, N_kappa) of Section 3.5, with a largest diameter [length].
struct BisectionOptions {
  double n_in = 1.6;
  double n_off = 0.3;
  double n_kappa = 0.4;
  double max_size = std::numeric_limits<double>::infinity();
};

/// Returns the distance of the two corners of each triangle that are farthest apart [length], shape
/// (num_triangles).
[[nodiscard]] Eigen::VectorXd diameters(const mesh::Surface& surface);

/// Computes the largest diameter that each triangle should have [length], shape (num_triangles),
/// the smallest of
///
///     width / N_in      in the interface, where |c| < 0.95 at one of its six nodes
///     width / N_off     in the bulk of a phase
///     N_kappa / I       I the mean of |Q| over its six nodes
///     max_size
///
/// the first two for a two-phase vesicle only. Throws ConfigError when an array has not one row for
/// each node or is not finite.
[[nodiscard]] Eigen::VectorXd wanted_diameters(const mesh::Surface& surface,
                                               const fem::NodalShapeOperator& shape_operator,
                                               const adapt::PhaseInterface& phases,
                                               const BisectionOptions& options);

/// What is to be done with a triangle.
enum class Mark { coarsen, keep, refine };

/// Marks every triangle with a diameter above the wanted one for one bisection, and every one below
/// half of it for coarsening. Would the refined mesh have more than `max_nodes` nodes, all wanted
/// diameters grow by one factor, in steps of 5 %, until it has not, or nothing is refined.
[[nodiscard]] std::vector<Mark> marks(const mesh::Surface& surface,
                                      const Eigen::VectorXd& wanted_diameters, double max_nodes);

/// Returns the same surface with the corners of every triangle rotated so that its longest edge
/// lies opposite corner 2 (of equal ones the one with the highest mid-edge node): how a mesh that
/// was not made by bisection begins. Since longest edges are ordered, later bisections can be
/// undone one by one; with edges that are not, vertices of valence 4 may be missing.
[[nodiscard]] mesh::Surface with_longest_sides_first(const mesh::Surface& surface);

/// A mesh after bisection, and what was done.
struct Bisected {
  adapt::Remeshed mesh;
  int num_bisected_edges = 0;    ///< each adds 4 nodes
  int num_removed_vertices = 0;  ///< each takes away 4 nodes

  [[nodiscard]] bool is_changed() const { return num_bisected_edges + num_removed_vertices > 0; }
};

/// Bisects the triangles marked for refinement, and as many others as the mesh needs to stay
/// conforming; then undoes bisections where all four triangles at the newest vertex are marked for
/// coarsening. For any genus.
///
///           2                 2          a triangle is bisected at the edge (0, 1) opposite its
///          / \               /|\         newest vertex, corner 2, or at its longest edge if that
///         /   \      ->     / | \        is more than 1 / 0.6 times as long. Children: (2, 0, 3)
///        /     \           /  |  \       and (1, 2, 3), in the place of the parent
///       0---3---1         0---3---1
///
/// Corner 2 of a child is its newest vertex, and children stand next to each other in the list of
/// triangles: that is all the history that coarsening needs, and the triangulation carries it.
///
/// New nodes are the points of the old triangles at the middles in (u, v), so a refined surface is
/// the old one exactly, and fields that are quadratic on a triangle keep all their values. A vertex
/// that goes becomes the mid-edge node between its neighbours; nodes are forgotten, none moves. It
/// stays if the merged triangles would have lower quality (3.5) than 0.3 and than the present ones,
/// or a fold.
///
/// Throws ConfigError when there is not one mark for each triangle.
[[nodiscard]] Bisected bisect(const mesh::Surface& old, std::span<const Mark> marks);

}  // namespace vesica::paper
