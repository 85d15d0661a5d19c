#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "disjoint_sets.hpp"
#include "side_normals.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/local_nodes.hpp"
#include "vesica/mesh/quality.hpp"
#include "volume_below.hpp"

namespace vesica::mesh {
namespace {

constexpr double smallest_relative_area = 1e-10;
constexpr double cosine_150_degrees = -0.86602540378443865;

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) {
  throw ConfigError("surface: " + fmt::format(text, std::forward<Args>(args)...));
}

std::string corners_of(const QuadraticTriangle& nodes) {
  return fmt::format("nodes {}, {}, {}", nodes[0], nodes[1], nodes[2]);
}

void check_finite(const Surface& surface) {
  if (surface.positions.rows() != surface.triangulation->num_nodes()) {
    refuse("{} positions: must be one for each of the {} nodes", surface.positions.rows(),
           surface.triangulation->num_nodes());
  }
  for (Eigen::Index node = 0; node < surface.positions.rows(); ++node) {
    if (!surface.positions.row(node).allFinite()) {
      refuse("node {} = ({}, {}, {}): must be finite", node, surface.positions(node, 0),
             surface.positions(node, 1), surface.positions(node, 2));
    }
  }
}

void check_distinct(const QuadraticTriangle& nodes, std::size_t t, const Positions& positions) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      if (positions.row(nodes[i]) == positions.row(nodes[j])) {
        refuse("triangle {} ({}): nodes {} and {} coincide", t, corners_of(nodes), nodes[i],
               nodes[j]);
      }
    }
  }
}

void check_element(const QuadraticTriangle& nodes, std::size_t t, const Positions& positions) {
  check_distinct(nodes, t, positions);
  std::array<Eigen::Vector3d, 4> normals;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto p = sub_triangle(nodes, sub_triangles[i], positions);
    normals[i] = area_vector(p);
    const double longest_squared = std::max(
        {(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    if (normals[i].norm() <= smallest_relative_area * longest_squared) {
      refuse("triangle {} ({}) is degenerate: its area must be > 0", t, corners_of(nodes));
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (normals[i].dot(normals[j]) <= 0) {
        refuse("triangle {} ({}) is folded: the normals of its parts must agree", t,
               corners_of(nodes));
      }
    }
  }
}

void check_neighbours(const Surface& surface) {
  const std::vector<SideNormal> sides =
      sorted_side_normals(*surface.triangulation, surface.positions);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    if (sides[i].normal.dot(sides[i + 1].normal) < cosine_150_degrees) {
      const auto [low, high] = std::minmax(sides[i].corner, sides[i].other_corner);
      refuse("edge ({}, {}): its triangles are folded onto each other", low, high);
    }
  }
}

/// Set of each triangle's component, by joining nodes.
std::vector<std::size_t> component_of_triangles(const Triangulation& triangulation) {
  DisjointSets sets(static_cast<std::size_t>(triangulation.num_nodes()));
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    for (std::size_t i = 1; i < 6; ++i) {
      sets.join(static_cast<std::size_t>(nodes[0]), static_cast<std::size_t>(nodes[i]));
    }
  }
  std::vector<std::size_t> components;
  components.reserve(triangulation.triangles().size());
  for (const QuadraticTriangle& nodes : triangulation.triangles()) {
    components.push_back(sets.find(static_cast<std::size_t>(nodes[0])));
  }
  return components;
}

/// Volume of the component of each node that names one, else 0. Taken around that node, because a
/// distant origin would drown it.
std::vector<double> component_volumes(const Surface& surface,
                                      const std::vector<std::size_t>& components) {
  std::vector<double> volumes(static_cast<std::size_t>(surface.positions.rows()), 0.0);
  for (std::size_t t = 0; t < components.size(); ++t) {
    const QuadraticTriangle& nodes = surface.triangulation->triangles()[t];
    const auto origin = surface.positions.row(static_cast<Eigen::Index>(components[t]));
    Positions local(6, 3);
    for (std::size_t i = 0; i < 6; ++i) {
      local.row(static_cast<Eigen::Index>(i)) = surface.positions.row(nodes[i]) - origin;
    }
    volumes[components[t]] += volume_below({0, 1, 2, 3, 4, 5}, local);
  }
  return volumes;
}

Surface check_outward(Surface surface, bool flip) {
  const std::vector<std::size_t> components = component_of_triangles(*surface.triangulation);
  const std::vector<double> volumes = component_volumes(surface, components);
  const auto triangles = surface.triangulation->triangles();
  std::vector<QuadraticTriangle> flipped(triangles.begin(), triangles.end());
  bool has_flipped = false;
  for (std::size_t t = 0; t < components.size(); ++t) {
    const double volume = volumes[components[t]];
    if (volume > 0) continue;
    if (!flip || volume == 0) {
      refuse(
          "triangle {} ({}) belongs to a component that is inside out: the enclosed volume {:.6g} "
          "must be > 0 (flip = true turns it)",
          t, corners_of(flipped[t]), volume);
    }
    const QuadraticTriangle n = flipped[t];
    flipped[t] = {n[0], n[2], n[1], n[5], n[4], n[3]};
    has_flipped = true;
  }
  if (has_flipped) {
    surface.triangulation = std::make_shared<const Triangulation>(
        std::move(flipped), surface.triangulation->num_nodes());
  }
  return surface;
}

}  // namespace

Surface check_geometry(Surface surface, bool flip) {
  check_finite(surface);
  const auto triangles = surface.triangulation->triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    check_element(triangles[t], t, surface.positions);
  }
  check_neighbours(surface);
  return check_outward(std::move(surface), flip);
}

}  // namespace vesica::mesh
