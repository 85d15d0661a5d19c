#include "cell_shapes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace vesica::shapes {
namespace {

using std::numbers::pi;

/// A point (rho, z) of a meridian for a colatitude in [0, pi].
using Meridian = std::function<Eigen::Vector2d(double)>;

struct Size {
  double area = 0;
  double volume = 0;
  [[nodiscard]] double reduced_volume() const {
    return 6 * std::sqrt(pi) * volume / std::pow(area, 1.5);
  }
};

/// Of the body of revolution, from cones: exact to 1e-6, which suffices for a start.
Size size_of(const Meridian& meridian) {
  constexpr int num_cones = 4000;
  Size size;
  Eigen::Vector2d a = meridian(0);
  for (int i = 1; i <= num_cones; ++i) {
    const Eigen::Vector2d b = meridian(pi * i / num_cones);
    size.area += pi * (a[0] + b[0]) * (b - a).norm();
    size.volume += pi / 3 * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) * (a[1] - b[1]);
    a = b;
  }
  size.volume = std::abs(size.volume);
  return size;
}

/// The member of a family whose reduced volume grows from `low` to `high` (or falls).
Meridian member(const std::function<Meridian(double)>& family, double low, double high,
                double reduced_volume) {
  const bool grows = size_of(family(low)).reduced_volume() < size_of(family(high)).reduced_volume();
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    const bool is_small = size_of(family(middle)).reduced_volume() < reduced_volume;
    (is_small == grows ? low : high) = middle;
  }
  return family(0.5 * (low + high));
}

/// z = cos (c_0 + c_1 sin^2 + c_2 sin^4) at rho = sin of the colatitude: from the sphere (part 0)
/// through the red cell of Evans and Fung (1972; part 1) to one whose poles nearly touch.
Meridian disc(double part) {
  const Eigen::Vector3d c =
      (1 - part) * Eigen::Vector3d(1, 0, 0) + part * Eigen::Vector3d(0.1036, 1.0013, -0.5614);
  return [c](double angle) -> Eigen::Vector2d {
    const double s = std::sin(angle) * std::sin(angle);
    return {std::sin(angle), std::cos(angle) * (c[0] + c[1] * s + c[2] * s * s)};
  };
}

/// A spherical shell of radii 1 - d and 1 + d, open above the angle 3 pi / 4 from its bottom, with
/// a round rim; the colatitude is the length along the meridian, from the inner pole.
Meridian cup(double d) {
  constexpr double opening = 0.75 * pi;
  const double inner = (1 - d) * opening;
  const double rim = pi * d;
  const double whole = inner + rim + (1 + d) * opening;
  return [=](double angle) -> Eigen::Vector2d {
    const double length = whole * angle / pi;
    const auto on_sphere = [](double radius, double from_bottom) -> Eigen::Vector2d {
      return {radius * std::sin(from_bottom), -radius * std::cos(from_bottom)};
    };
    if (length <= inner) return on_sphere(1 - d, length / (1 - d));
    if (length >= inner + rim)
      return on_sphere(1 + d, std::max(0.0, opening - (length - inner - rim) / (1 + d)));
    const double turn = (length - inner) / d;  // from the inner sphere over the rim to the outer
    const Eigen::Vector2d outward = on_sphere(1, opening);
    const Eigen::Vector2d upward(std::cos(opening), std::sin(opening));
    return outward + d * (std::sin(turn) * upward - std::cos(turn) * outward);
  };
}

mesh::Surface revolved(mesh::Surface sphere, const Meridian& meridian, double radius) {
  const double scale = radius * std::sqrt(4 * pi / size_of(meridian).area);
  for (auto node : sphere.positions.rowwise()) {
    const double distance = std::hypot(node[0], node[1]);
    const Eigen::Vector2d point = scale * meridian(std::atan2(distance, node[2]));
    if (distance > 0) node.head<2>() *= point[0] / distance;
    node[2] = point[1];
  }
  return sphere;
}

}  // namespace

mesh::Surface discocyte(mesh::Surface sphere, double reduced_volume, double radius) {
  return revolved(std::move(sphere), member(disc, 0, 1.1, reduced_volume), radius);
}

mesh::Surface stomatocyte(mesh::Surface sphere, double reduced_volume, double radius) {
  return revolved(std::move(sphere), member(cup, 0.02, 0.45, reduced_volume), radius);
}

}  // namespace vesica::shapes
