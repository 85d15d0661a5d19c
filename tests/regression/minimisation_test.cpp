#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "relaxation_cases.hpp"

namespace vesica {
namespace {

constexpr double pi = std::numbers::pi;

solve::SolverOptions minimize() {
  solve::SolverOptions options;
  options.method = solve::Method::minimize;
  return options;
}

void expect_converged(const test::RelaxationResult& result) {
  EXPECT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  ASSERT_TRUE(result.outcome.report.gradient);
  EXPECT_LT(*result.outcome.report.gradient, 1e-5);
  const auto& errors = result.outcome.diagnostics.constraint_errors;
  for (const auto& error : errors.values) EXPECT_LT(std::abs(error.value_or(0)), 1e-10);
}

/// Evaluations from the raw cigar; the tolerance of the energy is the discretisation error.
void expect_table_1(int resolution, double energy_tolerance, long max_evaluations) {
  const auto result = test::run_case(test::table_1_case(resolution), minimize());
  expect_converged(result);
  EXPECT_NEAR(result.energy(), test::table_1_energy, energy_tolerance);
  EXPECT_NEAR(result.volume_multiplier(), test::table_1_volume_multiplier, 5 * energy_tolerance);
  EXPECT_LE(result.counts().residuals, max_evaluations);
  EXPECT_GT(result.outcome.smallest_quality, 0.5);
}

TEST(MinimisationRegression, Table1With1154NodesTakesFewEvaluations) {
  expect_table_1(4, 8e-3, 60);
}

TEST(MinimisationRegression, Table1With4610NodesTakesNoMoreEvaluations) {
  expect_table_1(8, 8e-4, 60);
}

constexpr double prolate_energy = 34.870181359;
constexpr double prolate_volume = 3.351032163829;  // reduced volume 0.8 at area 4 pi

/// Semi-axes of an ellipsoid with the volume and area of the prolate.
const Eigen::Vector3d prolate_axes(1.8403904657183336, 0.6593105210860053, 0.6593105210860053);

TEST(MinimisationRegression, ProlateOfReducedVolume08) {
  const auto coarse = test::run_case(
      test::single_phase_case(test::make_ellipsoid(prolate_axes, 5), prolate_volume, 4 * pi),
      minimize());
  expect_converged(coarse);
  EXPECT_NEAR(coarse.energy(), prolate_energy, 1e-4 * prolate_energy);
  EXPECT_LE(coarse.counts().residuals, 50);
  const auto fine = test::run_case(
      test::single_phase_case(test::make_ellipsoid(prolate_axes, 8), prolate_volume, 4 * pi),
      minimize());
  expect_converged(fine);
  EXPECT_NEAR(fine.energy(), prolate_energy, 2e-5 * prolate_energy);
}

TEST(MinimisationRegression, APerturbedOblateLeavesTheSaddleAndBecomesTheProlate) {
  const double radius = 1.2467406836;
  const auto oblate = test::make_ellipsoid({1.01 * radius, 0.99 * radius, 0.5146805114}, 5);
  const auto result =
      test::run_case(test::single_phase_case(oblate, prolate_volume, 4 * pi), minimize());
  expect_converged(result);
  EXPECT_NEAR(result.energy(), prolate_energy, 2e-4 * prolate_energy);
  EXPECT_GT(result.outcome.smallest_quality, 0.25);
  EXPECT_LE(result.counts().residuals, 200);
}

test::RelaxationCase constant_gaussian_case(double rigidity) {
  auto c = test::table_1_case(3);
  c.model.material.gaussian_rigidity = {rigidity, rigidity};
  return c;
}

TEST(MinimisationRegression, AConstantGaussianRigidityChangesNothingButTheEnergy) {
  const auto without = test::run_case(constant_gaussian_case(0), minimize());
  const auto with = test::run_case(constant_gaussian_case(-0.7), minimize());
  expect_converged(with);
  EXPECT_NEAR(with.energy() - without.energy(), -0.7 * 4 * pi, 1e-9);
  EXPECT_LT((with.state.values.positions - without.state.values.positions).cwiseAbs().maxCoeff(),
            1e-9);
}

}  // namespace
}  // namespace vesica
