#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// Reference coordinates (u, v) of the six nodes of an element.
inline constexpr std::array<std::array<double, 2>, 6> node_parameters = {
    {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};

/// Local nodes of the four flat triangles of (3.5), oriented like the element; the last is the
/// middle one, the i-th of the others lies at corner i.
inline constexpr std::array<std::array<std::size_t, 3>, 4> sub_triangles = {
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

/// Returns the positions of three local nodes of an element [length].
[[nodiscard]] std::array<Eigen::Vector3d, 3> sub_triangle(const QuadraticTriangle& nodes,
                                                          const std::array<std::size_t, 3>& local,
                                                          const Positions& positions);

/// Returns the normal of a flat triangle, of the length of twice its area [length^2].
[[nodiscard]] Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace vesica::mesh
