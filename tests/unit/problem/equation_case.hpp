#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "block_matrices.hpp"
#include "relaxation_cases.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::problem {

/// A model on a small deformed sphere with fields and rates of no symmetry, far from equilibrium.
struct EquationCase {
  std::string name;
  mesh::Surface surface;
  model::Model model;
  EquationSettings settings{2.5, 30, ConstraintForm::differentiated};
  double time = 0.4;
  Eigen::VectorXd y;
  Eigen::VectorXd y_rate;

  [[nodiscard]] RelaxationProblem problem(int threads = 1) const {
    return {surface.triangulation, model, threads};
  }
};

/// Nodes of a unit sphere (N = 42), moved at random and stretched.
inline mesh::Surface deformed_sphere(std::mt19937& engine) {
  auto surface = test::make_sphere(1);
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k)
      surface.positions(i, k) += 0.04 * linalg::random_number(engine);
  }
  surface.positions.col(0) *= 1.4;
  return surface;
}

inline void fill_fields(EquationCase& c, std::mt19937& engine) {
  const DofLayout layout(c.surface.triangulation->num_nodes(), c.model);
  const auto n = layout.num_nodes();
  Fields values;
  values.positions = c.surface.positions;
  values.mean_curvature = -2 + 0.5 * linalg::random_vector(n, engine).array();
  values.order_parameter = 0.8 * linalg::random_vector(n, engine);
  values.multipliers = {3.0, -1.5, 0.7, 0.9};
  Fields rates;
  rates.positions = linalg::random_matrix(n, 3, engine);
  rates.mean_curvature = Eigen::VectorXd::Zero(n);
  rates.order_parameter = linalg::random_vector(n, engine);
  c.y = layout.pack(values);
  c.y_rate = layout.pack(rates);
}

/// Every constant differs between the phases; the targets of volume and phase move at the time of
/// the test.
inline model::Model two_phase_model() {
  model::Model model;
  model.material.bending_rigidity = {1.5, 0.9};
  model.material.spontaneous_curvature = {-1, 0.5};
  model.material.gaussian_rigidity = {0.7, -0.4};
  model.material.line_tension = 1.2;
  model.material.interface_width = 0.4;
  model.material.kinetic_coefficient = 0.3;
  model.targets.of<model::Volume>() = model::Schedule::ramp(5, 4, 0, 1);
  model.targets.of<model::Area>() = model::Schedule(14);
  model.targets.of<model::PhaseDifference>() = model::Schedule::ramp(1, 2, 0.2, 0.8);
  model.targets.of<model::TotalMeanCurvature>() = model::Schedule(-30);
  return model;
}

/// The same with every material parameter on its way.
inline model::Model model_in_motion() {
  using model::Schedule;
  auto model = two_phase_model();
  auto& material = model.material;
  material.bending_rigidity = {Schedule::ramp(1.5, 3, 0, 1), Schedule::ramp(2, 0.9, 0, 0.5)};
  material.spontaneous_curvature = {Schedule::ramp(0, -3, 0, 0.8), 0.5};
  material.gaussian_rigidity = {0.7, Schedule::ramp(0.7, -0.4, 0.2, 0.6)};
  material.line_tension =
      Schedule::points(model::ScheduleKind::stages, {0, 0.3, 0.6}, {0.1, 1.2, 4});
  material.interface_width = Schedule::ramp(1, 0.2, 0, 1);
  material.kinetic_coefficient = Schedule::ramp(1, 0, 0, 1);
  return model;
}

/// The material that `model` has at `time`, at all times.
inline model::Model with_material_at(model::Model model, double time) {
  const auto now = model.material.at(time);
  const auto pair = [](const model::PhasePair& k) {
    return model::PhaseSchedules{k.phase_1, k.phase_2};
  };
  model.material = {.bending_rigidity = pair(now.bending_rigidity),
                    .spontaneous_curvature = pair(now.spontaneous_curvature),
                    .gaussian_rigidity = pair(now.gaussian_rigidity),
                    .line_tension = now.line_tension,
                    .interface_width = now.interface_width,
                    .kinetic_coefficient = now.kinetic_coefficient};
  return model;
}

inline EquationCase make_equation_case(std::string name, const model::Model& model) {
  std::mt19937 engine(11);
  EquationCase c;
  c.name = std::move(name);
  c.surface = deformed_sphere(engine);
  c.model = model;
  fill_fields(c, engine);
  return c;
}

/// The cases of the Jacobian tests: all terms; a material in motion; constraints left free; one
/// phase.
inline std::vector<EquationCase> equation_cases() {
  std::vector<EquationCase> cases;
  cases.push_back(make_equation_case("two phases", two_phase_model()));
  cases.push_back(make_equation_case("two phases, material in motion", model_in_motion()));
  auto free_area = two_phase_model();
  free_area.targets.of<model::Area>().reset();
  cases.push_back(make_equation_case("two phases, area free", free_area));
  auto unconstrained = two_phase_model();
  unconstrained.targets = {};
  cases.push_back(make_equation_case("two phases, no constraint", unconstrained));
  auto single = two_phase_model();
  single.is_two_phase = false;
  single.targets.of<model::PhaseDifference>().reset();
  cases.push_back(make_equation_case("one phase", single));
  single.targets.of<model::Volume>().reset();
  cases.push_back(make_equation_case("one phase, volume free", single));
  return cases;
}

}  // namespace vesica::problem
