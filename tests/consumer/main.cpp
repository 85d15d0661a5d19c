// Relaxes a single-phase vesicle of reduced volume 0.9 from an ellipsoid, with the installed
// headers alone.

#include <array>
#include <cstdio>
#include <vesica/shapes/shapes.hpp>
#include <vesica/relax/damping_controller.hpp>
#include <vesica/relax/relax.hpp>
#include <vesica/run/make_stepper.hpp>

int main() {
  using namespace vesica;
  shapes::ShapeOptions shape;
  shape.kind = shapes::ShapeKind::ellipsoid;
  shape.semi_axes = {1.4, 0.83, 0.83};
  shape.resolution = 3;
  const auto surface = shapes::make_shape(shape);

  model::Model model;
  model.is_two_phase = false;
  model.targets.of<model::Volume>() = model::Schedule(3.769911184308);  // 0.9 of the unit sphere
  model.targets.of<model::Area>() = model::Schedule(12.566370614359);

  problem::State start;
  start.triangulation = surface.triangulation;
  start.values.positions = surface.positions;
  const auto stepper = run::make_stepper({}, model, start);

  relax::DampingController damping({}, problem::scales_of(model, start));
  const std::array<relax::Controller*, 1> controllers{&damping};
  const auto outcome = relax::relax(*stepper, model, {}, {}, controllers);
  std::printf("F = %.5f (prolate: 29.89902), %s\n", outcome.diagnostics.energy.total(),
              outcome.reason.c_str());
  return outcome.status == relax::RunStatus::converged ? 0 : 1;
}
