// 3. The pieces of a run
// ======================
//
// Introduction
// ------------
// `run::run` puts pieces together that a program may also use one by one: to start from a surface
// of its own, to look into the state between steps, or to leave out what it does not want. This
// program relaxes the vesicle of the first one by hand, and then minimises its energy from where
// the flow has come to rest.
//
// The commented program
// ---------------------
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vesica/measure/diagnostics.hpp>
#include <vesica/model/model.hpp>
#include <vesica/problem/scales.hpp>
#include <vesica/relax/damping_controller.hpp>
#include <vesica/relax/relax.hpp>
#include <vesica/run/make_stepper.hpp>
#include <vesica/shapes/shapes.hpp>

int main() {
  using namespace vesica;

  // A surface is a triangulation, which is shared and never changes, and the positions of its
  // nodes. Elements are quadratic: three corners and three nodes in the middles of the edges.
  shapes::ShapeOptions shape;
  shape.kind = shapes::ShapeKind::ellipsoid;
  shape.semi_axes = {1.4, 0.83, 0.83};
  shape.resolution = 4;
  const mesh::Surface surface = shapes::make_shape(shape);

  // The model says which physics: material (by default bending rigidity 1 and no spontaneous
  // curvature), one phase or two, and the targets of the constraints. A target that is absent is no
  // constraint.
  model::Model model;
  model.is_two_phase = false;
  model.targets.of<model::Volume>() = 0.9 * 4 * std::numbers::pi / 3;
  model.targets.of<model::Area>() = 4 * std::numbers::pi;

  // The state at the start has positions alone. The stepper finds the curvature, the velocity and
  // the multipliers that fit them, and owns the state from here on.
  problem::State start;
  start.triangulation = surface.triangulation;
  start.values.positions = surface.positions;
  const std::unique_ptr<solve::Stepper> flow = run::make_stepper({}, model, start);

  // One step by hand: IDA chooses its size; the argument is a time beyond which it must not go.
  const solve::StepReport first = flow->step(1);
  std::printf("first step: t = %.1e\n", first.time);

  // The loop takes the remaining ones. The damping controller moves the nodes within the surface so
  // that the mesh stays good; `scales` are the units of the case.
  relax::DampingController damping({}, problem::scales_of(model, start));
  const std::array<relax::Controller*, 1> controllers{&damping};
  const relax::Outcome outcome = relax::relax(*flow, model, {}, {}, controllers);
  const double energy = outcome.diagnostics.energy.total();
  std::printf("flow:     F = %.5f, %s\n", energy, outcome.reason.c_str());

  // The minimiser is a stepper, too. It begins at the state in which the flow rests.
  solve::SolverOptions options;
  options.method = solve::Method::minimize;
  const auto minimiser = run::make_stepper(options, model, flow->state());
  const relax::Outcome minimum = relax::relax(*minimiser, model, {}, {}, {});
  std::printf("minimum: F = %.5f, %s\n", minimum.diagnostics.energy.total(),
              minimum.reason.c_str());

  // Results
  // -------
  // Flow and minimiser look for the equilibria of two discretisations of the same energy: the weak
  // form and the discrete energy. They find 29.89956 and 29.89950, which differ by less than the
  // mesh itself makes wrong: the exact energy is 29.89902.
  const bool is_right = outcome.status == relax::RunStatus::converged &&
                        minimum.status == relax::RunStatus::converged &&
                        std::abs(energy - 29.89902) < 3e-3 &&
                        std::abs(minimum.diagnostics.energy.total() - 29.89902) < 3e-3;
  return is_right ? 0 : 1;
}
