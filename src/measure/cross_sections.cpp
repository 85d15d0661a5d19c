#include "cross_sections.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/disjoint_sets.hpp"
#include "vesica/fem/quadratic_triangle.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/mesh/local_nodes.hpp"

namespace vesica::measure {

/// Where the plane crosses the line between two nodes of an element.
struct CrossSections::Crossing {
  std::uint64_t line;  ///< the two nodes
  Eigen::Vector3d point;
  Eigen::Vector3d tangent;  ///< unit tangent of the cut, or 0 where the surface touches the plane
  double order_parameter;
};

namespace {

/// Root in [0, 1] of the parabola with values a, m, b at 0, 1/2, 1, where a and b have different
/// signs.
double crossing_parameter(double a, double m, double b) {
  const double slope = -3 * a - b + 4 * m;
  const double bend = 2 * a + 2 * b - 4 * m;
  const double direction = b > a ? 1 : -1;  // sign of the derivative at the root
  const double root = direction * std::sqrt(std::max(0.0, slope * slope - 4 * bend * a));
  if (a == 0) return 0;
  const double t = slope * direction >= 0 ? -2 * a / (slope + root) : (root - slope) / (2 * bend);
  return std::clamp(t, 0.0, 1.0);
}

/// Length of the circular arc over a chord from the tangents at its ends.
double arc_length(const Eigen::Vector3d& chord, const Eigen::Vector3d& tangent_a,
                  const Eigen::Vector3d& tangent_b) {
  const double half = 0.5 * std::atan2(tangent_a.cross(tangent_b).norm(), tangent_a.dot(tangent_b));
  return half > 1e-8 ? chord.norm() * half / std::sin(half) : chord.norm();
}

/// The two lines, numbered from 0, that each piece of a cut joins.
class Pieces {
 public:
  explicit Pieces(const std::vector<std::array<std::uint64_t, 2>>& pieces) {
    std::vector<std::uint64_t> lines;
    for (const auto& piece : pieces) lines.insert(lines.end(), piece.begin(), piece.end());
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    num_lines_ = lines.size();
    const auto number = [&](std::uint64_t line) {
      return static_cast<std::size_t>(std::lower_bound(lines.begin(), lines.end(), line) -
                                      lines.begin());
    };
    for (const auto& [a, b] : pieces) links_.push_back({number(a), number(b)});
  }

  [[nodiscard]] int num_loops() const {
    mesh::DisjointSets loops(num_lines_);
    for (const auto& [a, b] : links_) loops.join(a, b);
    return static_cast<int>(loops.num_sets());
  }

  /// The lines of each loop in order; the last one is the first once more.
  [[nodiscard]] std::vector<std::vector<std::size_t>> loops() const {
    std::vector<std::vector<std::size_t>> pieces_at(num_lines_);
    for (std::size_t piece = 0; piece < links_.size(); ++piece)
      for (const std::size_t line : links_[piece]) pieces_at[line].push_back(piece);
    std::vector<bool> is_done(links_.size(), false);
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t start = 0; start < links_.size(); ++start) {
      if (is_done[start]) continue;
      std::vector<std::size_t> loop{links_[start][0]};
      for (std::size_t piece = start; !is_done[piece];) {
        is_done[piece] = true;
        const auto& [a, b] = links_[piece];
        loop.push_back(loop.back() == a ? b : a);
        for (const std::size_t next : pieces_at[loop.back()])
          if (!is_done[next]) piece = next;
      }
      result.push_back(std::move(loop));
    }
    return result;
  }

 private:
  std::size_t num_lines_ = 0;
  std::vector<std::array<std::size_t, 2>> links_;
};

}  // namespace

CrossSections::CrossSections(const problem::State& state, const Eigen::Vector3d& direction)
    : state_(state), direction_(direction), heights_(state.values.positions * direction) {}

CrossSections::Crossing CrossSections::crossing(const mesh::QuadraticTriangle& triangle,
                                                std::size_t a, std::size_t b, double height) const {
  const auto [low, high] = std::minmax(triangle[a], triangle[b]);
  if (triangle[a] != low) std::swap(a, b);  // the same from both sides of the line
  const Eigen::Vector2d start(mesh::node_parameters[a].data());
  const Eigen::Vector2d end(mesh::node_parameters[b].data());
  const auto interpolate = [&](const std::array<double, 6>& weights) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 6; ++i)
      sum += weights[i] * state_.values.positions.row(triangle[i]).transpose();
    return sum;
  };
  const Eigen::Vector2d middle = 0.5 * (start + end);
  const double middle_height =
      direction_.dot(interpolate(fem::shape_values(middle.x(), middle.y()).value));
  const double t =
      crossing_parameter(heights_[low] - height, middle_height - height, heights_[high] - height);
  const Eigen::Vector2d at = start + t * (end - start);
  const auto shape = fem::shape_values(at.x(), at.y());
  Crossing result;
  result.line = (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high);
  result.point = interpolate(shape.value);
  result.tangent =
      interpolate(shape.du).cross(interpolate(shape.dv)).cross(direction_).normalized();
  const auto& c = state_.values.order_parameter;
  result.order_parameter = state_.is_two_phase() ? fem::combine<1>(c, triangle, shape.value)[0] : 0;
  return result;
}

template <class Add>
void CrossSections::for_each_piece(double height, const Add& add) const {
  for (const auto& triangle : state_.triangulation->triangles()) {
    std::array<bool, 6> above{};
    for (std::size_t i = 0; i < 6; ++i) above[i] = heights_[triangle[i]] > height;
    for (const auto& corners : mesh::sub_triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto alone = corners[k];
        const auto next = corners[(k + 1) % 3];
        const auto last = corners[(k + 2) % 3];
        if (above[alone] == above[next] || above[alone] == above[last]) continue;
        add(crossing(triangle, alone, next, height), crossing(triangle, alone, last, height));
      }
    }
  }
}

CrossSection CrossSections::at(double height) const {
  double perimeter = 0;
  std::vector<std::array<std::uint64_t, 2>> pieces;
  for_each_piece(height, [&](const Crossing& from, const Crossing& to) {
    perimeter += arc_length(to.point - from.point, from.tangent, to.tangent);
    pieces.push_back({from.line, to.line});
  });
  return {perimeter, Pieces(pieces).num_loops()};
}

std::vector<SectionLoop> CrossSections::loops_at(double height) const {
  std::map<std::uint64_t, SectionPoint> points;  // in the order of the numbers of the lines
  std::vector<std::array<std::uint64_t, 2>> pieces;
  for_each_piece(height, [&](const Crossing& from, const Crossing& to) {
    points.insert({from.line, {from.point, from.order_parameter}});
    points.insert({to.line, {to.point, to.order_parameter}});
    pieces.push_back({from.line, to.line});
  });
  std::vector<SectionPoint> numbered;
  for (const auto& [line, point] : points) numbered.push_back(point);
  std::vector<SectionLoop> result;
  for (const auto& lines : Pieces(pieces).loops()) {
    SectionLoop& loop = result.emplace_back();
    for (const std::size_t line : lines) loop.push_back(numbered[line]);
  }
  return result;
}

namespace {

constexpr int num_samples = 256;
constexpr double least_dip = 2e-3;

/// Index of the smallest one-loop sample that is a local minimum well below larger ones on both
/// sides, or 0.
std::size_t find_neck(const std::vector<CrossSection>& samples) {
  const std::size_t n = samples.size();
  std::vector<double> largest_after(n, 0.0);
  for (std::size_t j = n - 1; j-- > 0;) {
    largest_after[j] = std::max(largest_after[j + 1], samples[j + 1].perimeter);
  }
  std::size_t neck = 0;
  double largest_before = 0;
  for (std::size_t j = 1; j + 1 < n; ++j) {
    largest_before = std::max(largest_before, samples[j - 1].perimeter);
    const double value = samples[j].perimeter;
    const bool is_minimum = value <= samples[j - 1].perimeter && value <= samples[j + 1].perimeter;
    const bool is_dip = value < (1 - least_dip) * std::min(largest_before, largest_after[j]);
    if (!is_minimum || !is_dip || samples[j].num_loops != 1) continue;
    if (neck == 0 || value < samples[neck].perimeter) neck = j;
  }
  return neck;
}

}  // namespace

std::optional<double> neck_radius(const problem::State& state, const LongAxis& axis) {
  if (!axis.is_unique) return std::nullopt;
  const CrossSections sections(state, axis.direction);
  const double step = (axis.high - axis.low) / num_samples;
  const auto height = [&](std::size_t j) {
    return axis.low + (static_cast<double>(j) + 0.5) * step;
  };
  std::vector<CrossSection> samples;
  for (std::size_t j = 0; j < num_samples; ++j) samples.push_back(sections.at(height(j)));
  const std::size_t neck = find_neck(samples);
  if (neck == 0) return std::nullopt;
  const auto perimeter = [&](double at) { return sections.at(at).perimeter; };
  const auto smallest = boost::math::tools::brent_find_minima(
      perimeter, height(neck - 1), height(neck + 1), std::numeric_limits<double>::digits / 2);
  return smallest.second / (2 * std::numbers::pi);
}

}  // namespace vesica::measure
