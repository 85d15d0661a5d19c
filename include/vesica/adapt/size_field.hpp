#pragma once

#include <Eigen/Core>
#include <cmath>

#include "vesica/core/fields.hpp"
#include "vesica/fem/node_graph.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::adapt {

/// Options that tell how long the edges of elements should be.
struct SizeFieldOptions {
  double max_size = 0.3;
  double curvature_angle = 0.4;
  double interface_size = 0.85;
  double growth = 0.25;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"max_size", "length", "largest edge of an element", Rule::positive}, self.max_size);
    visit(Field{"curvature_angle", "rad",
                "edge times |Q|, Q the shape operator: 0.35 to 0.5 in motion, 0.18 for a "
                "final mesh",
                Rule::positive},
          self.curvature_angle);
    visit(Field{"interface_size", "-",
                "edge in the phase interface over the interface width: 0.7 to 1 in motion, 0.2 to "
                "0.5 for a final mesh",
                Rule::positive},
          self.interface_size);
    visit(Field{"growth", "-", "largest change of the edge length with distance", Rule::positive},
          self.growth);
  }
};

/// The order parameter and the width of the interface, which tell where phases meet; for a
/// single-phase vesicle the order parameter has no entries.
struct PhaseInterface {
  Eigen::VectorXd order_parameter;  ///< c, shape (N)
  double width = 0;                 ///< epsilon [length]

  /// Tells whether a node lies in the interface: |c| < 0.95, which is tanh(1.83).
  [[nodiscard]] bool contains(Eigen::Index node) const {
    return order_parameter.size() > 0 && std::abs(order_parameter[node]) < 0.95;
  }
};

/// Computes the wanted length of edges at each node [length], shape (N):
///
///     L = min(max_size, curvature_angle / |Q|, interface_size * width in the interface),
///
/// then lowered to L_i <= L_j + growth * distance, along the edges of `graph`, that of the surface.
/// Throws ConfigError when an array has not one row for each node or is not finite.
[[nodiscard]] Eigen::VectorXd size_field(const mesh::Surface& surface, const fem::NodeGraph& graph,
                                         const fem::NodalShapeOperator& shape_operator,
                                         const PhaseInterface& phases,
                                         const SizeFieldOptions& options);

/// Estimates the number of nodes of a mesh of equilateral quadratic triangles with these edges,
/// 8 / sqrt(3) int 1 / L^2; local_remesh comes within 25 %.
[[nodiscard]] double wanted_nodes(const mesh::Surface& surface, const Eigen::VectorXd& sizes);

/// Returns the largest quotient of the distance between two corners of a triangle and the mean of
/// the sizes there; local_remesh leaves about 1.4.
[[nodiscard]] double longest_relative_edge(const mesh::Surface& surface,
                                           const Eigen::VectorXd& sizes);

/// Returns the sizes, all enlarged by the one factor with which at most `max_nodes` nodes are
/// wanted.
[[nodiscard]] Eigen::VectorXd limited_sizes(const mesh::Surface& surface, Eigen::VectorXd sizes,
                                            double max_nodes);

}  // namespace vesica::adapt
