#include "check_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "torus_mesh.hpp"
#include "vesica/core/error.hpp"

namespace vesica::shapes {
namespace {

constexpr double most_nodes = 2e7;
constexpr int most_tips = 60;

template <class T>
[[noreturn]] void refuse(std::string_view key, const T& value, std::string_view rule) {
  throw ConfigError(fmt::format("shape.{} = {}: {}", key, value, rule));
}

void check_positive(std::string_view key, double value) {
  if (!(value > 0) || !std::isfinite(value)) refuse(key, value, "must be > 0 and finite");
}

void check_capsule(const ShapeOptions& options) {
  check_positive("length", options.length);
  check_positive("diameter", options.diameter);
  if (options.diameter > options.length) {
    refuse("diameter", options.diameter,
           fmt::format("must be <= shape.length = {}", options.length));
  }
}

void check_peanut(const ShapeOptions& options) {
  check_capsule(options);
  check_positive("waist", options.waist);
  if (options.waist >= options.diameter) {
    refuse("waist", options.waist, fmt::format("must be < shape.diameter = {}", options.diameter));
  }
}

void check_ellipsoid(const ShapeOptions& options) {
  if (!(options.semi_axes.minCoeff() > 0) || !options.semi_axes.allFinite()) {
    refuse("semi_axes",
           fmt::format("[{}, {}, {}]", options.semi_axes.x(), options.semi_axes.y(),
                       options.semi_axes.z()),
           "must be > 0 and finite");
  }
}

void check_torus(const ShapeOptions& options) {
  check_positive("major_radius", options.major_radius);
  check_positive("minor_radius", options.minor_radius);
  if (options.minor_radius >= options.major_radius) {
    refuse("minor_radius", options.minor_radius,
           fmt::format("must be < shape.major_radius = {}", options.major_radius));
  }
  if (options.resolution < 3) {
    refuse("resolution", options.resolution, "must be >= 3 (elements around the tube)");
  }
}

void check_tips(const ShapeOptions& options) {
  check_positive("radius", options.radius);
  check_positive("tip_width", options.tip_width);
  if (!(options.tip_height >= 0) || !std::isfinite(options.tip_height)) {
    refuse("tip_height", options.tip_height, "must be >= 0 and finite");
  }
  if (options.number_of_tips < 1 || options.number_of_tips > most_tips) {
    refuse("number_of_tips", options.number_of_tips,
           fmt::format("must be between 1 and {}", most_tips));
  }
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
    case ShapeKind::tips:
      return options.base == SphereBase::cube ? 24 * std::exp2(m) + 2 : 40 * m * m + 2;
    case ShapeKind::file:
      break;
  }
  return 0;
}

}  // namespace

void check_options(const ShapeOptions& options) {
  if (options.kind == ShapeKind::file) {
    if (options.path.empty()) refuse("path", "\"\"", "must name a file");
    return;
  }
  if (options.resolution < 1) refuse("resolution", options.resolution, "must be >= 1");
  switch (options.kind) {
    case ShapeKind::capsule:
      check_capsule(options);
      break;
    case ShapeKind::peanut:
      check_peanut(options);
      break;
    case ShapeKind::sphere:
      check_positive("radius", options.radius);
      break;
    case ShapeKind::ellipsoid:
      check_ellipsoid(options);
      break;
    case ShapeKind::torus:
      check_torus(options);
      break;
    case ShapeKind::tips:
      check_tips(options);
      break;
    case ShapeKind::file:
      break;
  }
  if (const double nodes = expected_nodes(options); nodes > most_nodes) {
    refuse("resolution", options.resolution,
           fmt::format("makes {:.3g} nodes: must be at most {:.3g}", nodes, most_nodes));
  }
}

int number_of_cubes(const ShapeOptions& options) {
  return static_cast<int>(std::round(options.length / options.diameter));
}

}  // namespace vesica::shapes
