#include "long_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vesica/fem/surface_integral.hpp"
#include "vesica/linalg/dense.hpp"

namespace vesica::measure {
namespace {

struct Range {
  double low;
  double high;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Inner extremum of the parabola with values a, m, b at 0, 1/2, 1.
void include_edge(Range& range, double a, double m, double b) {
  const double slope = -3 * a - b + 4 * m;
  const double bend = 2 * a + 2 * b - 4 * m;
  const double t = -slope / (2 * bend);
  if (t > 0 && t < 1) range.include(a + t * (slope + t * bend));  // false for bend = 0
}

/// Exact range of the quadratic with values f at the nodes of a triangle.
void include_triangle(Range& range, const std::array<double, 6>& f) {
  for (const double value : f) range.include(value);
  include_edge(range, f[0], f[3], f[1]);
  include_edge(range, f[1], f[4], f[2]);
  include_edge(range, f[2], f[5], f[0]);
  const double u1 = -3 * f[0] - f[1] + 4 * f[3];
  const double v1 = -3 * f[0] - f[2] + 4 * f[5];
  const double uu = 2 * f[0] + 2 * f[1] - 4 * f[3];
  const double vv = 2 * f[0] + 2 * f[2] - 4 * f[5];
  const double uv = 4 * (f[0] - f[3] + f[4] - f[5]);
  const double determinant = 4 * uu * vv - uv * uv;
  const double u = (uv * v1 - 2 * vv * u1) / determinant;
  const double v = (uv * u1 - 2 * uu * v1) / determinant;
  if (u > 0 && v > 0 && u + v < 1) range.include(f[0] + 0.5 * (u1 * u + v1 * v));
}

Range extent(const problem::State& state, const Eigen::Vector3d& direction) {
  const Eigen::VectorXd heights = state.values.positions * direction;
  Range range{heights[0], heights[0]};
  for (const auto& triangle : state.triangulation->triangles()) {
    std::array<double, 6> f{};
    for (std::size_t i = 0; i < 6; ++i) f[i] = heights[triangle[i]];
    include_triangle(range, f);
  }
  return range;
}

Eigen::Matrix3d variance(const problem::State& state) {
  const auto& positions = state.values.positions;
  double area = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d origin = positions.colwise().mean();  // near the centroid: no cancellation
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const auto point = fem::vector_at(positions, sample);
        const Eigen::Vector3d x = Eigen::Vector3d(point.x, point.y, point.z) - origin;
        area += sample.weight;
        first += sample.weight * x;
        second += sample.weight * x * x.transpose();
      });
  return second / area - first * first.transpose() / (area * area);
}

/// Turns the direction to the chord between its two outermost nodes while that makes the extent
/// larger.
Eigen::Vector3d towards_largest_extent(const mesh::Positions& positions,
                                       Eigen::Vector3d direction) {
  constexpr int most_turns = 50;
  double length = 0;
  for (int turn = 0; turn < most_turns; ++turn) {
    Eigen::Index lowest = 0;
    Eigen::Index highest = 0;
    const Eigen::VectorXd heights = positions * direction;
    const double width = heights.maxCoeff(&highest) - heights.minCoeff(&lowest);
    if (width <= length * (1 + 1e-12)) break;
    length = width;
    direction = (positions.row(highest) - positions.row(lowest)).transpose().normalized();
  }
  return direction;
}

/// From directions spread evenly over a half sphere (a golden spiral).
Eigen::Vector3d direction_of_largest_extent(const mesh::Positions& positions) {
  constexpr int num_starts = 40;
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double longest = 0;
  for (int k = 0; k < num_starts; ++k) {
    const double z = (k + 0.5) / num_starts;
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    const auto direction =
        towards_largest_extent(positions, {radius * std::cos(angle), radius * std::sin(angle), z});
    const Eigen::VectorXd heights = positions * direction;
    const double length = heights.maxCoeff() - heights.minCoeff();
    if (length <= longest) continue;
    longest = length;
    best = direction;
  }
  return best;
}

}  // namespace

LongAxis long_axis(const problem::State& state) {
  constexpr double least_difference = 0.01;
  const auto eigen = linalg::symmetric_eigensystem(variance(state));
  LongAxis axis;
  axis.is_unique = eigen.values[1] < (1 - least_difference) * eigen.values[2];
  axis.direction = axis.is_unique ? Eigen::Vector3d(eigen.vectors.col(2))
                                  : direction_of_largest_extent(state.values.positions);
  const auto range = extent(state, axis.direction);
  axis.low = range.low;
  axis.high = range.high;
  return axis;
}

}  // namespace vesica::measure
