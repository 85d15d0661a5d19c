#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::test {

inline constexpr double pi = std::numbers::pi;

inline shapes::ShapeOptions shape(shapes::ShapeKind kind, int resolution,
                                  shapes::SphereBase base = shapes::SphereBase::icosahedron) {
  shapes::ShapeOptions options;
  options.kind = kind;
  options.resolution = resolution;
  options.base = base;
  return options;
}

inline double volume_of(const shapes::ShapeOptions& options) {
  const mesh::Surface surface = shapes::make_shape(options);
  return mesh::enclosed_volume(*surface.triangulation, surface.positions);
}

inline double area_of(const shapes::ShapeOptions& options) {
  const mesh::Surface surface = shapes::make_shape(options);
  const std::vector<double> areas = mesh::element_areas(*surface.triangulation, surface.positions);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// Exponent p of an error that falls like resolution^-p.
template <class Measure>
double order(const Measure& measure, double exact, shapes::ShapeOptions options, int coarse,
             int fine) {
  options.resolution = coarse;
  const double coarse_error = std::abs(measure(options) - exact);
  options.resolution = fine;
  const double fine_error = std::abs(measure(options) - exact);
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
}

/// Largest |distance(x)| over the nodes.
template <class Distance>
double largest_distance(const mesh::Surface& surface, Distance distance) {
  double largest = 0;
  for (Eigen::Index node = 0; node < surface.positions.rows(); ++node) {
    const Eigen::Vector3d x = surface.positions.row(node);
    largest = std::max(largest, std::abs(distance(x)));
  }
  return largest;
}

inline double quality_of(const shapes::ShapeOptions& options) {
  const mesh::Surface surface = shapes::make_shape(options);
  return mesh::quality(*surface.triangulation, surface.positions);
}

}  // namespace vesica::test
