#include "vesica/measure/phase_domains.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mesh/disjoint_sets.hpp"
#include "vesica/fem/quadrature.hpp"
#include "vesica/fem/surface_element.hpp"
#include "vesica/mesh/local_nodes.hpp"

namespace vesica::measure {
namespace {

using Parameters = Eigen::Vector2d;

Parameters parameters_of(std::size_t local_node) {
  return Parameters(mesh::node_parameters[local_node].data());
}

double cross(const Parameters& a, const Parameters& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The quadratic surface and the quadratic c over one triangle.
class Element {
 public:
  Element(const problem::State& state, const mesh::QuadraticTriangle& nodes) {
    for (std::size_t i = 0; i < 6; ++i) {
      positions_.row(static_cast<Eigen::Index>(i)) = state.values.positions.row(nodes[i]);
      levels_[i] = state.values.order_parameter[nodes[i]];
    }
  }

  [[nodiscard]] const std::array<double, 6>& levels() const { return levels_; }
  [[nodiscard]] Eigen::Vector3d point(const fem::ShapeValues& shape) const {
    return combined(shape.value);
  }
  [[nodiscard]] Eigen::Vector3d point(const Parameters& p) const {
    return point(fem::shape_values(p.x(), p.y()));
  }
  [[nodiscard]] double area_element(const fem::ShapeValues& shape) const {
    return combined(shape.du).cross(combined(shape.dv)).norm();
  }
  [[nodiscard]] double level(const Parameters& p) const {
    return sum(fem::shape_values(p.x(), p.y()).value);
  }
  [[nodiscard]] Parameters level_gradient(const Parameters& p) const {
    const auto shape = fem::shape_values(p.x(), p.y());
    return {sum(shape.du), sum(shape.dv)};
  }

 private:
  [[nodiscard]] Eigen::Vector3d combined(const std::array<double, 6>& weights) const {
    return positions_.transpose() * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(weights.data());
  }
  [[nodiscard]] double sum(const std::array<double, 6>& weights) const {
    double result = 0;
    for (std::size_t i = 0; i < 6; ++i) result += weights[i] * levels_[i];
    return result;
  }

  Eigen::Matrix<double, 6, 3> positions_;
  std::array<double, 6> levels_{};
};

/// Where c changes its sign between two points at which it has different signs.
Parameters crossing(const Element& element, const Parameters& from, const Parameters& to) {
  const double start = element.level(from);
  const double middle = element.level(0.5 * (from + to));
  const double end = element.level(to);
  // start + b t + a t^2, the root in (0, 1) without cancellation
  const double a = 2 * start - 4 * middle + 2 * end;
  const double b = 4 * middle - 3 * start - end;
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * start));
  const double t = 2 * start / (-b + std::copysign(root, start));
  return from + std::clamp(t, 0.0, 1.0) * (to - from);
}

/// The point of the curve c = 0 beside the middle of a chord of it; the middle where the curve is
/// not near.
Parameters middle_of_curve(const Element& element, const Parameters& from, const Parameters& to) {
  const Parameters chord = to - from;
  const Parameters across(-chord.y(), chord.x());
  const Parameters middle = 0.5 * (from + to);
  double offset = 0;
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Parameters p = middle + offset * across;
    const double slope = element.level_gradient(p).dot(across);
    const double value = element.level(p);
    if (std::abs(value) > 0.5 * std::abs(slope)) return middle;
    if (slope != 0) offset -= value / slope;
  }
  return std::abs(offset) < 0.5 ? Parameters(middle + offset * across) : middle;
}

/// Adds the parts of elements to a domain.
class DomainSum {
 public:
  explicit DomainSum(PhaseDomain& domain) : domain_(domain) {}

  void add_element(const Element& element) {
    for (const auto& point : fem::triangle_rule()) add_point(element, point.shape, point.weight);
  }

  /// `corners` of a convex polygon in reference coordinates, counter-clockwise; `is_on_curve`: its
  /// corner lies on c = 0.
  struct Corner {
    Parameters parameters;
    bool is_on_curve;
  };
  struct Polygon {
    std::array<Corner, 4> corners;
    std::size_t size = 0;
    void push(const Parameters& p, bool is_on_curve) { corners[size++] = {p, is_on_curve}; }
  };
  void add_polygon(const Element& element, const Polygon& polygon) {
    const auto& corners = polygon.corners;
    for (std::size_t i = 2; i < polygon.size; ++i)
      add_triangle(element, corners[0].parameters, corners[i - 1].parameters,
                   corners[i].parameters);
    for (std::size_t i = 0; i < polygon.size; ++i) {
      const auto& next = corners[(i + 1) % polygon.size];
      if (corners[i].is_on_curve && next.is_on_curve)
        add_boundary(element, corners[i].parameters, next.parameters);
    }
  }

 private:
  void add_point(const Element& element, const fem::ShapeValues& shape, double weight) {
    const double area = weight * element.area_element(shape);
    domain_.area += area;
    domain_.centroid += area * element.point(shape);
  }

  /// The rule of the mid-side points, exact for degree 2.
  void add_triangle(const Element& element, const Parameters& a, const Parameters& b,
                    const Parameters& c) {
    const double weight = cross(b - a, c - a) / 6;
    for (const Parameters& p :
         {Parameters(0.5 * (a + b)), Parameters(0.5 * (b + c)), Parameters(0.5 * (c + a))})
      add_point(element, fem::shape_values(p.x(), p.y()), weight);
  }

  /// The curve between two of its points: length by extrapolation from one and two chords, and the
  /// area of the parabola between curve and chord.
  void add_boundary(const Element& element, const Parameters& from, const Parameters& to) {
    const Parameters middle = middle_of_curve(element, from, to);
    const Eigen::Vector3d start = element.point(from);
    const Eigen::Vector3d half = element.point(middle);
    const Eigen::Vector3d end = element.point(to);
    domain_.boundary_length +=
        (4 * ((half - start).norm() + (end - half).norm()) - (end - start).norm()) / 3;
    const double bulge = -2.0 / 3 * cross(to - from, middle - 0.5 * (from + to));
    const Parameters inside = 0.5 * (middle + 0.5 * (from + to));
    add_point(element, fem::shape_values(inside.x(), inside.y()), bulge);
  }

  PhaseDomain& domain_;
};

/// Numbers of the nodes' domains; `none` where c = 0.
struct NodeDomains {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t count = 0;
  std::vector<std::size_t> of_node;
};

NodeDomains node_domains(const problem::State& state) {
  const auto& c = state.values.order_parameter;
  const auto value = [&](mesh::NodeIndex node) { return c[node]; };
  const auto num_nodes = static_cast<std::size_t>(c.size());
  mesh::DisjointSets sets(num_nodes);
  for (const auto& nodes : state.triangulation->triangles()) {
    for (const auto& corners : mesh::sub_triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto a = nodes[corners[i]];
        const auto b = nodes[corners[(i + 1) % 3]];
        if (value(a) * value(b) > 0)
          sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
      }
    }
  }
  NodeDomains domains;
  domains.of_node.assign(num_nodes, NodeDomains::none);
  std::vector<std::size_t> number(num_nodes, NodeDomains::none);
  for (std::size_t node = 0; node < num_nodes; ++node) {
    if (c[static_cast<Eigen::Index>(node)] == 0) continue;
    std::size_t& domain = number[sets.find(node)];
    if (domain == NodeDomains::none) domain = domains.count++;
    domains.of_node[node] = domain;
  }
  return domains;
}

/// The part of a sub-triangle in which sign * c > 0.
DomainSum::Polygon clipped(const Element& element, const std::array<std::size_t, 3>& corners,
                           double sign) {
  DomainSum::Polygon polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = corners[i];
    const std::size_t b = corners[(i + 1) % 3];
    const double level = sign * element.levels()[a];
    const double next = sign * element.levels()[b];
    if (level >= 0) polygon.push(parameters_of(a), level == 0);
    if (level * next < 0) polygon.push(crossing(element, parameters_of(a), parameters_of(b)), true);
  }
  return polygon;
}

void add_cut_element(const Element& element, const mesh::QuadraticTriangle& nodes,
                     const NodeDomains& of, std::vector<PhaseDomain>& domains) {
  for (const auto& corners : mesh::sub_triangles) {
    for (const double sign : {1.0, -1.0}) {
      const auto inside = std::find_if(corners.begin(), corners.end(), [&](std::size_t corner) {
        return sign * element.levels()[corner] > 0;
      });
      if (inside == corners.end()) continue;
      const auto domain = of.of_node[static_cast<std::size_t>(nodes[*inside])];
      DomainSum(domains[domain]).add_polygon(element, clipped(element, corners, sign));
    }
  }
}

}  // namespace

std::vector<PhaseDomain> phase_domains(const problem::State& state) {
  if (!state.is_two_phase()) return {};
  const auto& c = state.values.order_parameter;
  const NodeDomains of = node_domains(state);
  std::vector<PhaseDomain> domains(of.count);
  for (std::size_t node = 0; node < of.of_node.size(); ++node) {
    if (of.of_node[node] != NodeDomains::none)
      domains[of.of_node[node]].phase = c[static_cast<Eigen::Index>(node)] > 0 ? 1 : 2;
  }
  for (const auto& nodes : state.triangulation->triangles()) {
    const Element element(state, nodes);
    const auto [low, high] = std::minmax_element(element.levels().begin(), element.levels().end());
    if (*low * *high > 0) {
      DomainSum(domains[of.of_node[static_cast<std::size_t>(nodes[0])]]).add_element(element);
    } else {
      add_cut_element(element, nodes, of, domains);
    }
  }
  for (PhaseDomain& domain : domains)
    if (domain.area > 0) domain.centroid /= domain.area;
  std::stable_sort(domains.begin(), domains.end(), [](const PhaseDomain& a, const PhaseDomain& b) {
    return a.phase != b.phase ? a.phase < b.phase : a.area > b.area;
  });
  return domains;
}

int num_domains(const std::vector<PhaseDomain>& domains, int phase) {
  return static_cast<int>(
      std::count_if(domains.begin(), domains.end(),
                    [phase](const PhaseDomain& domain) { return domain.phase == phase; }));
}

}  // namespace vesica::measure
