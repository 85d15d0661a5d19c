#include "profiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace vesica::shapes {
namespace {

constexpr double pi = std::numbers::pi;

/// Largest sqrt(1 - s^2) (a + b s^2) over s, for a, b > 0.
double largest_radius(double a, double b) {
  const double s_squared = std::max(0.0, (2 * b - a) / (3 * b));
  return std::sqrt(1 - s_squared) * (a + b * s_squared);
}

/// The b for which the largest radius is `radius` > a; it grows with b.
double bulge_of(double a, double radius) {
  double low = 0;
  double high = a + radius;
  while (largest_radius(a, high) < radius) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (largest_radius(a, middle) < radius ? low : high) = middle;
  }
  return high;
}

/// Peanut curve over the angle t in [0, pi], s = cos t.
struct PeanutCurve {
  double half_length;
  double half_waist;
  double bulge;

  [[nodiscard]] double thickness(double t) const {
    return half_waist + bulge * std::cos(t) * std::cos(t);
  }
  [[nodiscard]] Eigen::Vector2d point(double t) const {
    return {half_length * (1 - std::cos(t)), std::sin(t) * thickness(t)};
  }
  [[nodiscard]] double speed(double t) const {
    const double dx = half_length * std::sin(t);
    const double drho = std::cos(t) * (thickness(t) - 2 * bulge * std::sin(t) * std::sin(t));
    return std::hypot(dx, drho);
  }
};

/// Integral of a positive smooth function over [0, pi] in steps, and its inverse.
class Cumulative {
 public:
  template <class Function>
  explicit Cumulative(const Function& function) {
    const double step = pi / num_steps;
    sums_.push_back(0);
    for (int i = 0; i < num_steps; ++i) {
      const double begin = i * step;
      sums_.push_back(
          sums_.back() +
          step / 6 * (function(begin) + 4 * function(begin + 0.5 * step) + function(begin + step)));
      slopes_.push_back(function(begin));
    }
    slopes_.push_back(function(pi));
  }
  [[nodiscard]] double total() const { return sums_.back(); }

  /// t where the integral from 0 is `fraction` of the total: cubic between the steps.
  [[nodiscard]] double inverse(double fraction) const {
    const double target = fraction * total();
    const auto above = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, target);
    const auto i = static_cast<std::size_t>(above - sums_.begin()) - 1;
    const double step = pi / num_steps;
    const double width = sums_[i + 1] - sums_[i];
    const double u = std::clamp((target - sums_[i]) / width, 0.0, 1.0);
    const double slope_begin = width / slopes_[i];
    const double slope_end = width / slopes_[i + 1];
    const double hermite = u * u * (3 - 2 * u) * step + u * (1 - u) * (1 - u) * slope_begin -
                           u * u * (1 - u) * slope_end;
    return static_cast<double>(i) * step + hermite;
  }

 private:
  static constexpr int num_steps = 2000;
  std::vector<double> sums_;
  std::vector<double> slopes_;
};

}  // namespace

RevolutionProfile capsule_profile(const ShapeOptions& options) {
  const double radius = 0.5 * options.diameter;
  const double length = options.length;
  const double quarter = 0.5 * pi * radius;
  const double meridian = length - options.diameter + 2 * quarter;
  const auto point = [=](double parameter) -> Eigen::Vector2d {
    const bool is_right = parameter > 0.5;
    const double arc = meridian * (is_right ? 1 - parameter : parameter);
    const double angle = std::min(arc / radius, 0.5 * pi);
    const double x = radius * (1 - std::cos(angle)) + std::max(0.0, arc - quarter);
    return {is_right ? length - x : x, radius * std::sin(angle)};
  };
  return {point, meridian};
}

RevolutionProfile peanut_profile(const ShapeOptions& options) {
  const double half_waist = 0.5 * options.waist;
  const PeanutCurve curve{0.5 * options.length, half_waist,
                          bulge_of(half_waist, 0.5 * options.diameter)};
  const Cumulative arc_length([&](double t) { return curve.speed(t); });
  Cumulative weighted([&](double t) { return curve.speed(t) / std::sqrt(curve.thickness(t)); });
  const auto point = [curve, weighted = std::move(weighted)](double parameter) -> Eigen::Vector2d {
    const bool is_right = parameter > 0.5;
    Eigen::Vector2d result = curve.point(weighted.inverse(is_right ? 1 - parameter : parameter));
    if (is_right) result.x() = 2 * curve.half_length - result.x();
    return result;
  };
  return {point, arc_length.total()};
}

}  // namespace vesica::shapes
