#include "vesica/paper/conformal_remesh.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "vesica/mesh/surface_locator.hpp"
#include "vesica/paper/conformal_map.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::paper {
namespace {

constexpr int first_resolution = 3;  // 362 nodes
constexpr int max_rounds = 40;

mesh::Surface coarse_sphere() {
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.resolution = first_resolution;
  return with_longest_sides_first(shapes::make_shape(options));
}

/// The inverse of the conformal map: what lies on the sphere goes to the surface.
class InverseMap {
 public:
  InverseMap(const mesh::Surface& surface, const ConformalMap& map)
      : sphere_(surface.triangulation, map.images),
        surface_(surface.triangulation, surface.positions) {}

  [[nodiscard]] adapt::Remeshed lay(const mesh::Surface& sphere) const {
    adapt::Remeshed result;
    result.surface = sphere;
    result.origins.reserve(static_cast<std::size_t>(sphere.positions.rows()));
    for (Eigen::Index node = 0; node < sphere.positions.rows(); ++node)
      result.origins.push_back(origin_of(sphere.positions.row(node)));
    const auto origin = [&](mesh::NodeIndex node) -> mesh::SurfaceLocation& {
      return result.origins[static_cast<std::size_t>(node)];
    };
    for (const mesh::QuadraticTriangle& nodes : sphere.triangulation->triangles()) {
      for (std::size_t side = 0; side < 3; ++side) {
        // Each edge runs upwards in one of its two triangles.
        if (nodes[side] > nodes[(side + 1) % 3]) continue;
        const Eigen::Vector3d middle =
            0.5 * (origin(nodes[side]).point + origin(nodes[(side + 1) % 3]).point);
        mesh::SurfaceLocation& place = origin(nodes[3 + side]);
        place = surface_.closest_from(place, middle);
      }
    }
    for (Eigen::Index node = 0; node < sphere.positions.rows(); ++node) {
      result.surface.positions.row(node) =
          result.origins[static_cast<std::size_t>(node)].point.transpose();
    }
    return result;
  }

 private:
  /// The image triangles and those of the surface have the same numbers and parameters.
  [[nodiscard]] mesh::SurfaceLocation origin_of(const Eigen::Vector3d& direction) const {
    mesh::SurfaceLocation place = sphere_.closest(direction);
    place.point = surface_.interpolate(place, surface_.positions());
    place.distance = 0;
    return place;
  }

  mesh::SurfaceLocator sphere_;
  mesh::SurfaceLocator surface_;
};

}  // namespace

std::optional<adapt::Remeshed> conformal_remesh(const mesh::Surface& old,
                                                const fem::NodalShapeOperator& shape_operator,
                                                const adapt::PhaseInterface& phases,
                                                const BisectionOptions& options, double max_nodes) {
  const ConformalMap map = conformal_map(old);
  if (map.num_flipped > 0) return std::nullopt;
  const InverseMap inverse(old, map);
  mesh::Surface sphere = coarse_sphere();
  adapt::Remeshed mesh = inverse.lay(sphere);
  for (int round = 0; round < max_rounds; ++round) {
    const auto there = [&](const auto& field) {
      return mesh::interpolate(*old.triangulation, mesh.origins, field);
    };
    adapt::PhaseInterface new_phases;
    new_phases.width = phases.width;
    if (phases.order_parameter.size() > 0)
      new_phases.order_parameter = there(phases.order_parameter);
    const Eigen::VectorXd wanted =
        wanted_diameters(mesh.surface, there(shape_operator), new_phases, options);
    std::vector<Mark> found = marks(mesh.surface, wanted, max_nodes);
    std::replace(found.begin(), found.end(), Mark::coarsen, Mark::keep);
    const Bisected finer = bisect(sphere, found);
    const auto num_nodes = finer.mesh.surface.triangulation->num_nodes();
    if (!finer.is_changed() || num_nodes > max_nodes) break;
    sphere = finer.mesh.surface;
    sphere.positions.rowwise().normalize();
    mesh = inverse.lay(sphere);
  }
  return mesh;
}

}  // namespace vesica::paper
