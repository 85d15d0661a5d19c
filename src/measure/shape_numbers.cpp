#include <cmath>
#include <numbers>

#include "cross_sections.hpp"
#include "long_axis.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/measure/phase_domains.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::measure {
namespace {

struct SurfaceMeasures {
  double volume = 0;
  double area = 0;
  double phase_difference = 0;
};

SurfaceMeasures measure_surface(const problem::State& state) {
  SurfaceMeasures sum;
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        sum.area += sample.weight;
        sum.volume += sample.weight *
                      dot(fem::vector_at(state.values.positions, sample), sample.frame.normal) / 3;
        if (!state.is_two_phase()) return;
        sum.phase_difference += sample.weight * model::phase_indicator(fem::scalar_at(
                                                    state.values.order_parameter, sample));
      });
  return sum;
}

void add_phase_numbers(const model::Material& material, const problem::State& state,
                       const SurfaceMeasures& measures, ShapeNumbers& numbers) {
  const double rigidity = material.bending_rigidity.phase_1;
  numbers.phase_fraction = (measures.area - measures.phase_difference) / (2 * measures.area);
  numbers.reduced_line_tension =
      numbers.characteristic_radius * 4.0 / 3.0 * material.line_tension / rigidity;
  numbers.rigidity_ratio = material.bending_rigidity.phase_2 / rigidity;
  numbers.saddle_splay_difference = material.gaussian_rigidity.difference() / rigidity;
  const auto domains = phase_domains(state);
  numbers.domains_1 = num_domains(domains, 1);
  numbers.domains_2 = num_domains(domains, 2);
}

}  // namespace

ShapeNumbers shape_numbers(const model::Model& model, const problem::State& state) {
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

}  // namespace vesica::measure
