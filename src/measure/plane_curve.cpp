#include "plane_curve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

namespace vesica::measure {
namespace {

constexpr double steps_per_length = 24;
constexpr int max_steps = 30;
constexpr double smallest_ratio = 0.7;  // of two steps: below it is another curve

/// Cuts of the sub-triangles by parallel planes.
class ParallelPlanes {
 public:
  ParallelPlanes(const FlatTriangulation& flat, const mesh::Positions& positions,
                 std::span<const mesh::NodeIndex> loop)
      : flat_(flat), positions_(positions) {
    for (const mesh::NodeIndex node : loop) centre_ += point(node);
    centre_ /= static_cast<double>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector3d next = point(loop[(i + 1) % loop.size()]);
      normal_ += (point(loop[i]) - centre_).cross(next - centre_);
      length_ += (next - point(loop[i])).norm();
    }
    normal_.normalize();
  }

  [[nodiscard]] bool are_defined() const { return normal_.squaredNorm() > 0; }
  [[nodiscard]] double length_of_loop() const { return length_; }

  /// The curve in the plane at a distance from that of the loop, over the nearest of the edges.
  [[nodiscard]] std::optional<PlaneCurve> curve_at(double shift,
                                                   std::span<const std::int32_t> edges) const {
    double smallest = std::numeric_limits<double>::infinity();
    std::int32_t nearest = -1;
    for (const std::int32_t edge : edges) {
      if (!cuts(edge, shift)) continue;
      const double distance = (crossing(edge, shift) - centre_ - shift * normal_).squaredNorm();
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = edge;
    }
    if (nearest < 0) return std::nullopt;
    return curve_over(nearest, shift);
  }

 private:
  [[nodiscard]] const FlatTriangulation::Edge& edge_of(std::int32_t edge) const {
    return flat_.edges[static_cast<std::size_t>(edge)];
  }
  [[nodiscard]] Eigen::Vector3d point(mesh::NodeIndex node) const { return positions_.row(node); }
  [[nodiscard]] double height(mesh::NodeIndex node) const {
    return normal_.dot(point(node) - centre_);
  }
  [[nodiscard]] bool cuts(std::int32_t edge, double shift) const {
    return (height(edge_of(edge).from) >= shift) != (height(edge_of(edge).to) >= shift);
  }
  [[nodiscard]] Eigen::Vector3d crossing(std::int32_t edge, double shift) const {
    const Eigen::Vector3d from = point(edge_of(edge).from);
    const double below = height(edge_of(edge).from) - shift;
    const double above = height(edge_of(edge).to) - shift;
    return from + below / (below - above) * (point(edge_of(edge).to) - from);
  }
  /// The other edge of a triangle that the plane cuts.
  [[nodiscard]] std::int32_t next_edge(std::int32_t triangle, std::int32_t edge,
                                       double shift) const {
    for (const std::int32_t other : flat_.edges_of[static_cast<std::size_t>(triangle)])
      if (other != edge && cuts(other, shift)) return other;
    return edge;
  }
  [[nodiscard]] std::optional<PlaneCurve> curve_over(std::int32_t first, double shift) const {
    PlaneCurve curve;
    std::int32_t edge = first;
    std::int32_t triangle = edge_of(first).triangles[0];
    do {
      const std::int32_t next = next_edge(triangle, edge, shift);
      const Eigen::Vector3d from = crossing(edge, shift);
      const Eigen::Vector3d to = crossing(next, shift);
      curve.length += (to - from).norm();
      curve.centre += 0.5 * (to - from).norm() * (from + to);
      if (curve.length > length_) return std::nullopt;
      const auto& pair = edge_of(next).triangles;
      triangle = pair[0] == triangle ? pair[1] : pair[0];
      edge = next;
    } while (edge != first);
    if (!(curve.length > 0)) return std::nullopt;
    curve.centre /= curve.length;
    return curve;
  }

  const FlatTriangulation& flat_;
  const mesh::Positions& positions_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double length_ = 0;
};

}  // namespace

std::optional<PlaneCurve> narrowest_plane_curve(const FlatTriangulation& flat,
                                                const NodeEdges& edges_at,
                                                const mesh::Positions& positions,
                                                std::span<const mesh::NodeIndex> loop,
                                                std::span<const mesh::NodeIndex> nearby) {
  const ParallelPlanes planes(flat, positions, loop);
  if (!planes.are_defined()) return std::nullopt;
  std::vector<std::int32_t> edges;
  for (const mesh::NodeIndex node : nearby)
    edges.insert(edges.end(), edges_at[node].begin(), edges_at[node].end());
  std::optional<PlaneCurve> shortest = planes.curve_at(0, edges);
  if (!shortest) return std::nullopt;
  const double step = planes.length_of_loop() / steps_per_length;
  for (const double direction : {step, -step}) {
    for (int i = 1; i <= max_steps; ++i) {
      auto curve = planes.curve_at(i * direction, edges);
      const double ratio = curve ? curve->length / shortest->length : 0;
      if (ratio >= 1 || ratio < smallest_ratio) break;
      shortest = std::move(curve);
    }
  }
  return shortest;
}

}  // namespace vesica::measure
