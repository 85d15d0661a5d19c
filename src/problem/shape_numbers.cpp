#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "connected_components.hpp"
#include "cross_sections.hpp"
#include "long_axis.hpp"
#include "surface_integral.hpp"
#include "vesica/model/two_phase.hpp"
#include "vesica/problem/diagnostics.hpp"

namespace vesica::problem {
namespace {

/// Sides of the four sub-triangles of an element, as local nodes.
constexpr std::array<std::array<std::size_t, 2>, 9> sub_edges = {
    {{0, 3}, {3, 1}, {1, 4}, {4, 2}, {2, 5}, {5, 0}, {3, 4}, {4, 5}, {5, 3}}};

/// Connected sets of nodes with sign * c > 0, neighbours along the sub-edges.
int num_domains(const State& state, double sign) {
  const auto& c = state.values.order_parameter;
  constexpr std::size_t outside = -1;
  std::vector<std::size_t> number(static_cast<std::size_t>(c.size()), outside);
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    if (sign * c[i] > 0) number[static_cast<std::size_t>(i)] = count++;
  }
  std::vector<std::array<std::size_t, 2>> links;
  for (const auto& triangle : state.triangulation->triangles()) {
    for (const auto& [a, b] : sub_edges) {
      const auto from = number[static_cast<std::size_t>(triangle[a])];
      const auto to = number[static_cast<std::size_t>(triangle[b])];
      if (from != outside && to != outside) links.push_back({from, to});
    }
  }
  return num_components(count, links);
}

struct SurfaceMeasures {
  double volume = 0;
  double area = 0;
  double phase_difference = 0;
};

SurfaceMeasures measure_surface(const State& state) {
  SurfaceMeasures sum;
  for_each_point(state, [&](const SurfaceSample& sample) {
    sum.area += sample.weight;
    sum.volume +=
        sample.weight * dot(vector_at(state.values.positions, sample), sample.frame.normal) / 3;
    if (!state.is_two_phase()) return;
    sum.phase_difference +=
        sample.weight * model::phase_indicator(scalar_at(state.values.order_parameter, sample));
  });
  return sum;
}

void add_phase_numbers(const model::Material& material, const State& state,
                       const SurfaceMeasures& measures, ShapeNumbers& numbers) {
  const double rigidity = material.bending_rigidity.phase_1;
  numbers.phase_fraction = (measures.area - measures.phase_difference) / (2 * measures.area);
  numbers.reduced_line_tension =
      numbers.characteristic_radius * 4.0 / 3.0 * material.line_tension / rigidity;
  numbers.rigidity_ratio = material.bending_rigidity.phase_2 / rigidity;
  numbers.saddle_splay_difference = material.gaussian_rigidity.difference() / rigidity;
  numbers.domains_1 = num_domains(state, 1);
  numbers.domains_2 = num_domains(state, -1);
}

}  // namespace

ShapeNumbers shape_numbers(const model::Model& model, const State& state) {
  const auto measures = measure_surface(state);
  ShapeNumbers numbers;
  numbers.characteristic_radius = std::sqrt(measures.area / (4 * std::numbers::pi));
  numbers.reduced_volume =
      measures.volume / (4 * std::numbers::pi / 3 * std::pow(numbers.characteristic_radius, 3));
  const auto axis = long_axis(state);
  numbers.length = axis.high - axis.low;
  numbers.neck_radius = neck_radius(state, axis);
  if (model.is_two_phase && state.is_two_phase()) {
    add_phase_numbers(model.material.at(state.time), state, measures, numbers);
  }
  return numbers;
}

}  // namespace vesica::problem
