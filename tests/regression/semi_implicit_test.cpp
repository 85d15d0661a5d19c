#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fixed_step_runs.hpp"

namespace vesica {
namespace {

/// Below this normal velocity over R_c the shape is nearly at rest: F is then within 1e-3 of its
/// final value.
constexpr double resting_velocity = 0.1;

/// Keeps the largest constraint error and the largest rises of the energy in a step, while the
/// shape moves and at rest.
class Watch final : public relax::Observer {
 public:
  void observe(const relax::StepView& view) override {
    const double energy = view.diagnostics.energy.total();
    if (view.report.counts.steps > 0) {
      const auto& errors = view.diagnostics.constraint_errors;
      for (const auto& error : errors.values)
        constraint_error = std::max(constraint_error, std::abs(error.value_or(0)));
      has_all_errors = has_all_errors && errors.of<model::Volume>() && errors.of<model::Area>() &&
                       errors.of<model::PhaseDifference>();
    }
    auto& rise =
        view.diagnostics.velocity.normal_rigid_free > resting_velocity ? moving_rise : resting_rise;
    if (view.report.counts.steps > 1) rise = std::max(rise, (energy - energy_) / energy);
    energy_ = energy;
  }

  double constraint_error = 0;
  bool has_all_errors = true;
  double moving_rise = -std::numeric_limits<double>::infinity();  // relative
  double resting_rise = moving_rise;

 private:
  double energy_ = 0;
};

struct PaperRun {
  relax::Outcome outcome;
  problem::State state;
  Watch watch;
};

/// Table 1, eps = 0.3, as the paper computes it: step (eps/30)^2, damping controller of 3.4.
void run_as_the_paper(int resolution, double end_time, PaperRun& run) {
  const auto cigar = test::table_1_case(resolution);
  solve::SolverOptions options;
  options.method = solve::Method::semi_implicit;
  const auto stepper = run::make_stepper(options, cigar.model, cigar.start);
  relax::DampingOptions paper;
  paper.kind = relax::DampingKind::paper;
  relax::DampingController damping(paper, problem::scales_of(cigar.model, cigar.start));
  relax::StopOptions stop;
  stop.normal_velocity = std::numeric_limits<double>::min();  // to the end time
  stop.end_time = end_time;
  stop.max_steps = 10000;
  const std::array<relax::Observer*, 1> observers{&run.watch};
  const std::array<relax::Controller*, 1> controllers{&damping};
  run.outcome = relax::relax(*stepper, cigar.model, stop, observers, controllers);
  run.state = stepper->state();
}

/// At rest F rises and falls by some 5e-8 of itself in a step: the multipliers change only every
/// few steps, when the constraints have drifted by 1e-8, alpha jumps by factors of ten, and kappa
/// answers both through the damping term of (3.4a).
constexpr double energy_noise = 1e-7;

TEST(SemiImplicitRegression, FollowsThePaperOnACoarseMesh) {
  PaperRun run;
  run_as_the_paper(2, 0.02, run);
  ASSERT_EQ(run.outcome.status, relax::RunStatus::end_time) << run.outcome.reason;
  EXPECT_EQ(run.outcome.report.counts.steps, 200);
  EXPECT_TRUE(run.watch.has_all_errors);
  EXPECT_LT(run.watch.constraint_error, 1e-8);
  EXPECT_LT(run.watch.moving_rise, 0);
  EXPECT_GT(run.outcome.smallest_quality, 0.45);
}

TEST(SlowSemiImplicitRegression, ReachesTheFirstRowOfTable1) {
  PaperRun run;
  run_as_the_paper(4, 0.45, run);
  ASSERT_EQ(run.outcome.status, relax::RunStatus::end_time) << run.outcome.reason;
  EXPECT_EQ(run.outcome.report.counts.steps, 4500);
  EXPECT_NEAR(run.outcome.diagnostics.energy.total(), test::table_1_energy, 5e-3);
  EXPECT_NEAR(*run.state.values.multipliers.of<model::Volume>(), test::table_1_volume_multiplier,
              1e-2);
  EXPECT_LT(run.watch.constraint_error, 1e-8);
  EXPECT_LT(run.watch.moving_rise, 0);
  EXPECT_LT(run.watch.resting_rise, energy_noise);
  EXPECT_GT(run.outcome.smallest_quality, 0.45);
}

}  // namespace
}  // namespace vesica
