#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "relaxation_cases.hpp"

namespace vesica {
namespace {

solve::SolverOptions variational(bool polish = false) {
  solve::SolverOptions options;
  options.scheme = solve::Scheme::variational;
  options.polish = polish;
  return options;
}

/// The largest change of E + sum lambda_i C_i in a step, lambda being the mean of the multipliers
/// before and after it: along a solution dE = -||v||^2 dt - lambda . dC. Apart, that in steps that
/// end at rest: there ||v||^2 dt is below what the tolerance of Newton's method leaves in E.
class LagrangianWatch final : public relax::Observer {
 public:
  void observe(const relax::StepView& view) override {
    const auto& measured = view.diagnostics;
    const auto& lambda = view.state.values.multipliers;
    const std::array values{measured.energy.total(), measured.measures.volume(),
                            measured.measures.area(),
                            measured.measures.phase_difference().value_or(0)};
    const std::array weights{1.0, lambda.of<model::Volume>().value_or(0),
                             lambda.of<model::Area>().value_or(0),
                             lambda.of<model::PhaseDifference>().value_or(0)};
    if (last_) {
      double change = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
        change += 0.5 * (weights[i] + last_weights_[i]) * (values[i] - (*last_)[i]);
      double& rise = measured.velocity.normal_rigid_free > 1e-2 ? moving_rise : resting_rise;
      rise = std::max(rise, change / values[0]);
    }
    last_ = values;
    last_weights_ = weights;
  }

  double moving_rise = -std::numeric_limits<double>::infinity();  ///< relative
  double resting_rise = moving_rise;

 private:
  std::optional<std::array<double, 4>> last_;
  std::array<double, 4> last_weights_{};
};

TEST(VariationalFlow, LowersTheEnergyInEveryStepAndFindsTable1) {
  LagrangianWatch watch;
  const std::array<relax::Observer*, 1> observers{&watch};
  const auto result = test::run_case(test::table_1_case(4), variational(), {}, observers);
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_LT(watch.moving_rise, 0);
  EXPECT_LT(watch.resting_rise, 1e-8);  // measured 2e-9
  EXPECT_LE(result.counts().steps, 55);
  EXPECT_LE(result.counts().factorisations, 12);
  EXPECT_NEAR(result.energy(), test::table_1_energy, 7e-3);  // measured 5.9e-3
  EXPECT_NEAR(result.volume_multiplier(), test::table_1_volume_multiplier, 2.5e-2);
}

TEST(VariationalFlow, EndsInTheSameEquilibriumWithFactorsAndWithThePreconditioner) {
  const auto c = test::table_1_case(4);
  auto options = variational();
  const auto preconditioned = test::run_case(c, options);
  options.linear_solver = solve::LinearSolver::klu;
  const auto factorised = test::run_case(c, options);
  ASSERT_EQ(preconditioned.outcome.status, relax::RunStatus::converged)
      << preconditioned.outcome.reason;
  ASSERT_EQ(factorised.outcome.status, relax::RunStatus::converged) << factorised.outcome.reason;
  EXPECT_NEAR(preconditioned.energy(), factorised.energy(), 1e-9 * factorised.energy());
  EXPECT_NEAR(preconditioned.volume_multiplier(), factorised.volume_multiplier(),
              1e-5 * factorised.volume_multiplier());
}

TEST(VariationalFlow, NeedsNoMoreKrylovIterationsOnAFinerMesh) {
  const auto iterations = [](int resolution) {
    const auto counts = test::run_case(test::table_1_case(resolution), variational()).counts();
    return static_cast<double>(counts.krylov) / static_cast<double>(counts.newton);
  };
  const double coarse = iterations(3);
  const double fine = iterations(8);
  EXPECT_GT(coarse, 0.5);
  EXPECT_LE(fine, 1.3 * coarse);
}

TEST(VariationalFlow, IsWithinAThousandthOfTable1WithFourThousandNodes) {
  const auto result = test::run_case(test::table_1_case(8), variational(true));
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_LE(result.counts().steps, 55);
  EXPECT_LE(result.counts().factorisations, 12 + result.outcome.report.polish->iterations + 1);
  EXPECT_NEAR(result.energy(), test::table_1_energy, 1e-3);
  EXPECT_NEAR(result.volume_multiplier(), test::table_1_volume_multiplier, 2e-3);
  EXPECT_GT(result.outcome.report.polish->curvature.value, 0);
}

TEST(VariationalFlow, LeavesTheOblateSaddleForTheProlateWithAGoodMesh) {
  // reference/axisymmetric.csv: prolate, v = 0.8
  constexpr double prolate_energy = 34.870181;
  const double pi = std::numbers::pi;
  const auto start = test::single_phase_case(test::make_ellipsoid({1.27, 1.23, 0.55}, 6),
                                             0.8 * 4 * pi / 3, 4 * pi);
  const auto result = test::run_case(start, variational());
  ASSERT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_NEAR(result.energy(), prolate_energy, 1e-4 * prolate_energy);
  EXPECT_GT(result.outcome.diagnostics.quality, 0.25);
}

}  // namespace
}  // namespace vesica
