#include "vesica/problem/scales.hpp"

#include <cmath>
#include <numbers>

#include "vesica/fem/surface_integral.hpp"

namespace vesica::problem {

Scales scales_of(const model::Model& model, const State& start) {
  double area = 0;
  if (model.targets.of<model::Area>()) {
    area = model.targets.of<model::Area>()->last();
  } else {
    fem::for_each_point(*start.triangulation, start.values.positions,
                        [&](const fem::SurfaceSample& sample) { area += sample.weight; });
  }
  return {std::sqrt(area / (4 * std::numbers::pi)), model.material.bending_rigidity.phase_1.last()};
}

}  // namespace vesica::problem
