#include <fmt/format.h>

#include <cmath>

#include "cell_shapes.hpp"
#include "core/refuse.hpp"
#include "torus_mesh.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {
namespace {

constexpr double most_nodes = 2e7;

void check_capsule(const ShapeOptions& options) {
  if (options.diameter > options.length) {
    refuse("shape.diameter", options.diameter,
           fmt::format("must be <= shape.length = {}", options.length));
  }
}

void check_peanut(const ShapeOptions& options) {
  if (options.waist >= options.diameter) {
    refuse("shape.waist", options.waist,
           fmt::format("must be < shape.diameter = {}", options.diameter));
  }
}

void check_torus(const ShapeOptions& options) {
  if (options.minor_radius >= options.major_radius) {
    refuse("shape.minor_radius", options.minor_radius,
           fmt::format("must be < shape.major_radius = {}", options.major_radius));
  }
  if (options.resolution < 3)
    refuse("shape.resolution", options.resolution, "must be >= 3 (elements around the tube)");
}

void check_reduced_volume(const ShapeOptions& options) {
  const bool is_disc = options.kind == ShapeKind::discocyte;
  const double least = is_disc ? least_discocyte : least_stomatocyte;
  const double most = is_disc ? 1 : most_stomatocyte;
  if (options.reduced_volume >= least && options.reduced_volume <= most) return;
  refuse("shape.reduced_volume", options.reduced_volume,
         fmt::format("must be between {} and {} for a {}", least, most, name_of(options.kind)));
}

double expected_nodes(const ShapeOptions& options) {
  const double m = options.resolution;
  switch (options.kind) {
    case ShapeKind::capsule:
    case ShapeKind::peanut:
      return 4 * (4 * std::round(options.length / options.diameter) + 2) * m * m + 2;
    case ShapeKind::torus:
      return 4 * m * torus_rows(options.major_radius, options.minor_radius, options.resolution);
    case ShapeKind::sphere:
    case ShapeKind::ellipsoid:
    case ShapeKind::discocyte:
    case ShapeKind::stomatocyte:
    case ShapeKind::tips:
      return options.base == SphereBase::cube ? 24 * std::exp2(m) + 2 : 40 * m * m + 2;
    case ShapeKind::file:
      break;
  }
  return 0;
}

}  // namespace

void ShapeOptions::check_together() const {
  if (kind == ShapeKind::file && path.empty()) refuse("shape.path", "\"\"", "must name a file");
  if (kind == ShapeKind::capsule || kind == ShapeKind::peanut) check_capsule(*this);
  if (kind == ShapeKind::peanut) check_peanut(*this);
  if (kind == ShapeKind::torus) check_torus(*this);
  if (kind == ShapeKind::discocyte || kind == ShapeKind::stomatocyte) check_reduced_volume(*this);
  if (const double nodes = expected_nodes(*this); nodes > most_nodes) {
    refuse("shape.resolution", resolution,
           fmt::format("makes {:.3g} nodes: must be at most {:.3g}", nodes, most_nodes));
  }
}

}  // namespace vesica::shapes
