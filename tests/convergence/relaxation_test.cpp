#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "observed_order.hpp"
#include "relaxation_cases.hpp"

namespace vesica {
namespace {

/// Errors of the relaxed eps = 0.3 case of Table 1 against the axisymmetric solution.
struct EquilibriumErrors {
  double energy;
  double volume_multiplier;
};

EquilibriumErrors table_1_errors(int resolution) {
  const auto result = test::run_case(test::table_1_case(resolution));
  EXPECT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  std::printf("m %d F err %.3e lam err %.3e\n", resolution, result.energy() - test::table_1_energy,
              result.volume_multiplier() - test::table_1_volume_multiplier);
  return {std::abs(result.energy() - test::table_1_energy),
          std::abs(result.volume_multiplier() - test::table_1_volume_multiplier)};
}

TEST(Table1Convergence, EnergyAndVolumeMultiplierConvergeWithTheMesh) {
  const auto coarse = table_1_errors(4);  // N = 1154
  const auto middle = table_1_errors(6);  // N = 2594
  const auto fine = table_1_errors(8);    // N = 4610
  EXPECT_LT(middle.energy, coarse.energy);
  EXPECT_LT(fine.energy, middle.energy);
  EXPECT_LT(middle.volume_multiplier, coarse.volume_multiplier);
  EXPECT_LT(fine.volume_multiplier, middle.volume_multiplier);
  EXPECT_GT(test::observed_order(coarse.energy, fine.energy, 2), 3);
  EXPECT_LT(fine.energy, 6e-4);
  EXPECT_LT(fine.volume_multiplier, 2e-3);
}

TEST(SlowTable1Convergence, ReachesFourDigitsOfTheEnergyWithFourteenThousandNodes) {
  const auto errors = table_1_errors(14);  // N = 14114
  EXPECT_LT(errors.energy, 1.5e-4);
  EXPECT_LT(errors.volume_multiplier, 2e-3);
}

/// Equilibria of one discrete problem differ by the stopping criterion alone: at a normal velocity
/// v the energy still falls at the rate v^2, the relaxation times are below 0.1, and the energy is
/// quadratic about its minimum.
TEST(TimeTolerance, DoesNotChangeTheEquilibrium) {
  solve::SolverOptions options;
  relax::StopOptions stop;
  stop.normal_velocity = 1e-4;
  stop.max_steps = 500;
  options.rtol = 1e-5;
  const auto reference = test::run_case(test::table_1_case(2), options, stop);
  ASSERT_EQ(reference.outcome.status, relax::RunStatus::converged) << reference.outcome.reason;
  long more_steps = reference.counts().steps;
  for (const double rtol : {1e-4, 1e-3, 1e-2}) {
    SCOPED_TRACE(rtol);
    options.rtol = rtol;
    const auto result = test::run_case(test::table_1_case(2), options, stop);
    ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
    std::printf("rtol %g steps %ld F diff %.3e lam diff %.3e\n", rtol, result.counts().steps,
                result.energy() - reference.energy(),
                result.volume_multiplier() - reference.volume_multiplier());
    EXPECT_NEAR(result.energy(), reference.energy(), 1e-5);
    EXPECT_NEAR(result.volume_multiplier(), reference.volume_multiplier(), 1e-2);
    EXPECT_LT(result.counts().steps, more_steps);
    more_steps = result.counts().steps;
  }
}

/// At a fixed time, far from equilibrium, the error is that of the time steps.
TEST(TimeTolerance, ControlsTheErrorOnTheWay) {
  const auto energy_at = [](double tolerance) {
    solve::SolverOptions options;
    options.rtol = tolerance;
    relax::StopOptions stop;
    stop.end_time = 5e-3;
    return test::run_case(test::table_1_case(2), options, stop).energy();
  };
  const double exact = energy_at(1e-6);
  const double loose = std::abs(energy_at(1e-2) - exact);
  const double middle = std::abs(energy_at(1e-3) - exact);
  const double tight = std::abs(energy_at(1e-4) - exact);
  std::printf("time errors %.2e %.2e %.2e\n", loose, middle, tight);
  EXPECT_LT(middle, loose);
  EXPECT_LT(tight, middle / 2);
}

}  // namespace
}  // namespace vesica
