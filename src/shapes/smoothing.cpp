#include "smoothing.hpp"

#include <algorithm>
#include <cstddef>

#include "core/refuse.hpp"

namespace vesica::shapes {
namespace {

/// The neighbours of each vertex, each once.
std::vector<std::vector<mesh::NodeIndex>> neighbours(const SurfaceData& data) {
  std::vector<std::vector<mesh::NodeIndex>> result(data.points.size());
  for (const mesh::Corners& corners : data.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t k : {(i + 1) % 3, (i + 2) % 3})
        result[static_cast<std::size_t>(corners[i])].push_back(corners[k]);
    }
  }
  for (auto& around : result) {
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }
  return result;
}

/// Moves each point by `part` of the way to the mean of its neighbours.
void move(std::vector<Eigen::Vector3d>& points,
          const std::vector<std::vector<mesh::NodeIndex>>& around, double part) {
  std::vector<Eigen::Vector3d> moved = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (around[i].empty()) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const mesh::NodeIndex k : around[i]) sum += points[static_cast<std::size_t>(k)];
    moved[i] += part * (sum / static_cast<double>(around[i].size()) - points[i]);
  }
  points = std::move(moved);
}

}  // namespace

/// G. Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995.
void smooth(SurfaceData& data, int passes) {
  if (!data.middles.empty())
    refuse("shape.smoothing", passes, "must be 0 for a file of quadratic triangles");
  const auto around = neighbours(data);
  for (int pass = 0; pass < passes; ++pass) {
    move(data.points, around, 0.5);
    move(data.points, around, -0.53);
  }
}

}  // namespace vesica::shapes
