#pragma once

#include <memory>

#include "relaxation_cases.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica::test {

/// Options of the paper's scheme with the step `tau`.
inline solve::SolverOptions semi_implicit_options(double tau, bool tangential_fields = true) {
  solve::SolverOptions options;
  options.method = solve::Method::semi_implicit;
  options.time_step.value = tau;
  options.tangential_fields = tangential_fields;
  return options;
}

/// The cigar of Table 1 with the volume and area that its mesh has: no constraint jumps at the
/// start, so that trajectories of different methods can be compared from t = 0 on.
inline RelaxationCase undisturbed_cigar(int resolution) {
  auto result = table_1_case(resolution);
  const auto measured = measure::measure(result.model, result.start);
  result.model.targets.of<model::Volume>() = model::Schedule(measured.measures.volume());
  result.model.targets.of<model::Area>() = model::Schedule(measured.measures.area());
  return result;
}

/// State at `end_time` with the damping held at `alpha`; ends early when a step fails.
inline problem::State state_at(const RelaxationCase& start, const solve::SolverOptions& options,
                               double end_time, double alpha) {
  const auto stepper = run::make_stepper(options, start.model, start.start);
  stepper->set_damping(alpha);
  while (stepper->state().time < end_time) {
    if (stepper->step(end_time).status == solve::StepStatus::failed) break;
  }
  return stepper->state();
}

}  // namespace vesica::test
