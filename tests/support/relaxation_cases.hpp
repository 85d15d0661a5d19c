#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "vesica/model/model.hpp"
#include "vesica/phase/initial_phase.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/damping_controller.hpp"
#include "vesica/relax/relax.hpp"
#include "vesica/run/make_stepper.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::test {

/// Model and start of a run.
struct RelaxationCase {
  model::Model model;
  problem::State start;
};

/// How a run ended and where.
struct RelaxationResult {
  relax::Outcome outcome;
  problem::State state;

  [[nodiscard]] double energy() const { return outcome.diagnostics.energy.total(); }
  [[nodiscard]] double volume_multiplier() const {
    return state.values.multipliers.of<model::Volume>().value();
  }
  [[nodiscard]] const solve::SolverCounts& counts() const { return outcome.report.counts; }
};

/// Equilibrium of Table 1 of the paper with eps = 0.3 (reference/axisymmetric.csv,
/// cigar-dumbbell): absolute error at most 1e-7.
inline constexpr double table_1_energy = 58.848254353;
inline constexpr double table_1_volume_multiplier = 27.185343785;

inline problem::State start_on(const mesh::Surface& surface) {
  problem::State start;
  start.triangulation = surface.triangulation;
  start.values.positions = surface.positions;
  start.values.mean_curvature = Eigen::VectorXd::Zero(surface.positions.rows());
  return start;
}

/// The paper's cigar with m = `resolution`, N = 72 m^2 + 2 nodes, and the ramp (4.1) of phases.
inline RelaxationCase table_1_case(int resolution) {
  shapes::ShapeOptions shape;
  shape.resolution = resolution;
  const auto surface = shapes::make_shape(shape);
  RelaxationCase result;
  auto& material = result.model.material;
  material.bending_rigidity = {1.5, 1};
  material.line_tension = 1;
  material.interface_width = 0.3;
  material.kinetic_coefficient = 0.1;
  const double pi = std::numbers::pi;
  result.model.targets = {11 * pi / 12, 4 * pi, 4.71};
  result.start = start_on(surface);
  result.start.values.order_parameter = phase::initial_phase({}, surface, 0.3, 4.71);
  return result;
}

/// The case of Table 1 in other units: lengths times `length`, energies times `energy`.
inline RelaxationCase in_units(const RelaxationCase& c, double length, double energy) {
  RelaxationCase result = c;
  result.start.values.positions *= length;
  auto& material = result.model.material;
  material.bending_rigidity = {1.5 * energy, energy};
  material.line_tension = material.line_tension.scaled(energy / length);
  material.interface_width = material.interface_width.scaled(length);
  material.kinetic_coefficient = material.kinetic_coefficient.scaled(length);
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t) {
    auto& target = result.model.targets.of<Constraint>();
    if (target) target = target->scaled(std::pow(length, Constraint::length_power));
  });
  return result;
}

/// One phase with k = 1 on `surface`, volume and area held at the given values.
inline RelaxationCase single_phase_case(const mesh::Surface& surface, double volume, double area) {
  RelaxationCase result;
  result.model.is_two_phase = false;
  result.model.targets = {volume, area, {}};
  result.start = start_on(surface);
  return result;
}

inline mesh::Surface make_sphere(int resolution, double radius = 1) {
  shapes::ShapeOptions shape;
  shape.kind = shapes::ShapeKind::sphere;
  shape.resolution = resolution;
  shape.radius = radius;
  return shapes::make_shape(shape);
}

inline mesh::Surface make_ellipsoid(const Eigen::Vector3d& semi_axes, int resolution) {
  shapes::ShapeOptions shape;
  shape.kind = shapes::ShapeKind::ellipsoid;
  shape.semi_axes = semi_axes;
  shape.resolution = resolution;
  return shapes::make_shape(shape);
}

/// Relaxes a case with the default damping.
inline RelaxationResult run_case(const RelaxationCase& start,
                                 const solve::SolverOptions& options = {},
                                 const relax::StopOptions& stop = {},
                                 std::span<relax::Observer* const> observers = {}) {
  const auto stepper = run::make_stepper(options, start.model, start.start);
  relax::DampingController damping({}, problem::scales_of(start.model, start.start));
  const std::array<relax::Controller*, 1> controllers{&damping};
  auto outcome = relax::relax(*stepper, start.model, stop, observers, controllers);
  return {std::move(outcome), stepper->state()};
}

}  // namespace vesica::test
