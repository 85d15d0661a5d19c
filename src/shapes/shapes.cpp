#include "vesica/shapes/shapes.hpp"

#include "cell_shapes.hpp"
#include "profiles.hpp"
#include "revolution_mesh.hpp"
#include "sphere_mesh.hpp"
#include "tip_directions.hpp"
#include "torus_mesh.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/surface_file.hpp"

namespace vesica::shapes {
namespace {

/// `profile` laid on glued cubes, its left end at x = 0 and its axis at y = z = diameter / 2.
mesh::Surface revolution_shape(const ShapeOptions& options, const RevolutionProfile& profile) {
  const auto num_cubes = static_cast<int>(std::round(options.length / options.diameter));
  // The rows of a meridian are equidistant at the angle length / ((n + 1) diameter); a fifth less
  // makes the corners of the end face blunter. Measured for length 4, 4610 nodes: quality 0.58
  // instead of 0.52, area ratio 1.37 instead of 1.53.
  constexpr double blunting = 0.8;
  const double cap_angle =
      blunting * profile.meridian_length / ((num_cubes + 1) * options.diameter);
  mesh::Surface surface =
      revolution_surface({num_cubes, options.resolution, cap_angle}, profile.point);
  surface.positions.rightCols<2>().array() += 0.5 * options.diameter;
  return surface;
}

mesh::Surface unit_sphere(const ShapeOptions& options) {
  return options.base == SphereBase::cube ? unit_sphere_from_cube(options.resolution)
                                          : unit_sphere_from_icosahedron(options.resolution);
}

mesh::Surface sphere_shape(const ShapeOptions& options) {
  mesh::Surface surface = unit_sphere(options);
  surface.positions *= options.radius;
  return surface;
}

mesh::Surface ellipsoid_shape(const ShapeOptions& options) {
  mesh::Surface surface = unit_sphere(options);
  surface.positions.array().rowwise() *= options.semi_axes.transpose().array();
  return surface;
}

mesh::Surface tips_shape(const ShapeOptions& options) {
  mesh::Surface surface = unit_sphere(options);
  const mesh::Positions tips = tip_directions(options.number_of_tips);
  const double width_squared = options.tip_width * options.tip_width;
  for (Eigen::Index node = 0; node < surface.positions.rows(); ++node) {
    const Eigen::Vector3d direction = surface.positions.row(node);
    const double sum = (((tips * direction).array() - 1) / width_squared).exp().sum();
    surface.positions.row(node) *= options.radius + options.tip_height * sum;
  }
  return surface;
}

}  // namespace

Shape start_shape(const ShapeOptions& options) {
  if (options.kind != ShapeKind::file) return {make_shape(options), {}, {}};
  check("shape", options, options.kind);
  return read_shape(options.path, {options.flip, options.repair, options.smoothing});
}

mesh::Surface make_shape(const ShapeOptions& options) {
  check("shape", options, options.kind);
  switch (options.kind) {
    case ShapeKind::capsule:
      return revolution_shape(options, capsule_profile(options));
    case ShapeKind::sphere:
      return sphere_shape(options);
    case ShapeKind::ellipsoid:
      return ellipsoid_shape(options);
    case ShapeKind::torus:
      return torus_surface(options.major_radius, options.minor_radius, options.resolution);
    case ShapeKind::peanut:
      return revolution_shape(options, peanut_profile(options));
    case ShapeKind::discocyte:
      return discocyte(unit_sphere(options), options.reduced_volume, options.radius);
    case ShapeKind::stomatocyte:
      return stomatocyte(unit_sphere(options), options.reduced_volume, options.radius);
    case ShapeKind::tips:
      return tips_shape(options);
    case ShapeKind::file:
      return start_shape(options).surface;
  }
  throw ConfigError("shape.kind: must be one of the named kinds");
}

}  // namespace vesica::shapes
