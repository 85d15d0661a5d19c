#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "long_axis.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::measure {

/// Curve in which a plane cuts the surface.
struct CrossSection {
  double perimeter = 0;  ///< of all loops together [length]
  int num_loops = 0;
};

/// A point of such a curve.
struct SectionPoint {
  Eigen::Vector3d position;
  double order_parameter = 0;  ///< 0 for a single-phase vesicle
};

/// A closed curve: the last point is the first once more.
using SectionLoop = std::vector<SectionPoint>;

/// Cuts of the quadratic surface by the planes x . direction = height.
class CrossSections {
 public:
  /// `state` must outlive this object.
  CrossSections(const problem::State& state, const Eigen::Vector3d& direction);

  /// The crossings of the edges of the sub-triangles are exact; between them the curve is taken as
  /// the circular arc that turns by the angle between its end tangents, so the perimeter's error
  /// falls with the fourth power of the mesh size.
  [[nodiscard]] CrossSection at(double height) const;
  /// The curves of a cut as polygons whose corners are the crossings of the edges.
  [[nodiscard]] std::vector<SectionLoop> loops_at(double height) const;

 private:
  struct Crossing;

  [[nodiscard]] Crossing crossing(const mesh::QuadraticTriangle& triangle, std::size_t a,
                                  std::size_t b, double height) const;
  /// Calls add(from, to) for every piece of the cut.
  template <class Add>
  void for_each_piece(double height, const Add& add) const;

  const problem::State& state_;
  Eigen::Vector3d direction_;
  Eigen::VectorXd heights_;  ///< x . direction at the nodes
};

/// Smallest radius (perimeter / 2 pi) of a one-loop cross-section between two larger ones; absent
/// when there is none or the axis is not unique. Dips of less than 0.2 % are taken for mesh noise.
[[nodiscard]] std::optional<double> neck_radius(const problem::State& state, const LongAxis& axis);

}  // namespace vesica::measure
