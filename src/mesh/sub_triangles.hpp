#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "vesica/mesh/triangulation.hpp"

namespace vesica::mesh {

/// Local nodes of the four flat triangles of (3.5), oriented like the element; the last is the
/// middle one, the i-th of the others lies at corner i.
inline constexpr std::array<std::array<std::size_t, 3>, 4> sub_triangles = {
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

[[nodiscard]] std::array<Eigen::Vector3d, 3> sub_triangle(const QuadraticTriangle& nodes,
                                                          const std::array<std::size_t, 3>& local,
                                                          const Positions& positions);

/// Normal times twice the area.
[[nodiscard]] Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners);

/// 1/3 int x . (x_u cross x_v) du dv over one quadratic triangle: its share of the enclosed volume.
[[nodiscard]] double volume_below(const QuadraticTriangle& nodes, const Positions& positions);

}  // namespace vesica::mesh
