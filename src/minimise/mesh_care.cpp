#include "mesh_care.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vesica/mesh/quality.hpp"
#include "vesica/mesh/redistribute.hpp"

namespace vesica::minimise {

namespace {

// A mesh that is no worse than the start (by the factors) is not called degenerate.
constexpr double lowest_quality = 0.1;
constexpr double largest_area_ratio = 200;
constexpr double lowest_cosine = 0;
constexpr double quality_against_start = 0.5;
constexpr double area_ratio_against_start = 4;

constexpr double good_quality = 0.4;
constexpr double quality_lost = 0.8;
constexpr double good_area_ratio = 8;
constexpr double area_ratio_gained = 2.5;

constexpr int sweeps = 20;

}  // namespace

MeshCondition mesh_condition(const mesh::Surface& surface) {
  const auto& triangulation = *surface.triangulation;
  return {mesh::quality(triangulation, surface.positions),
          mesh::area_ratio(triangulation, surface.positions),
          mesh::smallest_normal_cosine(triangulation, surface.positions)};
}

std::string describe(const MeshCondition& condition) {
  return fmt::format("quality {:.3f}, area ratio {:.3g}, smallest normal cosine {:.2f}",
                     condition.quality, condition.area_ratio, condition.normal_cosine);
}

MeshCare::MeshCare(const mesh::Surface& start) : start_(mesh_condition(start)), fresh_(start_) {}

MeshCare::MeshCare(const mesh::Surface& start, const MeshCondition& fresh)
    : start_(mesh_condition(start)), fresh_(fresh) {}

bool MeshCare::is_degenerate(const MeshCondition& condition) const {
  return condition.quality < std::min(lowest_quality, quality_against_start * start_.quality) ||
         condition.area_ratio >
             std::max(largest_area_ratio, area_ratio_against_start * start_.area_ratio) ||
         condition.normal_cosine < std::min(lowest_cosine, start_.normal_cosine);
}

bool MeshCare::is_worn(const MeshCondition& condition) const {
  return condition.quality < std::min(good_quality, quality_lost * fresh_.quality) ||
         condition.area_ratio > std::max(good_area_ratio, area_ratio_gained * fresh_.area_ratio);
}

MovedNodes MeshCare::redistribute(const mesh::Surface& surface,
                                  const Eigen::VectorXd& order_parameter) {
  const auto moved = mesh::redistribute(surface, sweeps);
  MovedNodes result{moved.positions, order_parameter};
  if (order_parameter.size() > 0) {
    result.order_parameter =
        mesh::interpolate(*surface.triangulation, moved.origins, order_parameter);
  }
  fresh_ = mesh_condition({surface.triangulation, result.positions});
  return result;
}

}  // namespace vesica::minimise
