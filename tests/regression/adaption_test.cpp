#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "relaxation_cases.hpp"
#include "vesica/config/config.hpp"
#include "vesica/relax/make_mesh_controller.hpp"
#include "vesica/setup/case.hpp"

namespace vesica {
namespace {

/// Relaxes a case of apps/cases by the flow with [adaption], and other options on top.
test::RelaxationResult run_adaptively(const std::string& name, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"solver.method=ida", "adaption.enabled=true"});
  const auto config =
      config::read_config(std::string(VESICA_CASES_DIR) + "/" + name + ".toml", overrides);
  const auto vesicle = setup::make_case(config);
  const auto scales = problem::scales_of(vesicle.model, vesicle.start);
  auto stepper = run::make_stepper(config.solver, vesicle.model, vesicle.start);
  relax::DampingController damping(config.damping, scales);
  const auto mesh = relax::make_mesh_controller(config.adaption, vesicle.model, scales);
  const std::array<relax::Controller*, 2> controllers{&damping, mesh.get()};
  const auto restart = [&](problem::State start, const solve::Restart& how) {
    return run::restart_stepper(config.solver, vesicle.model, std::move(start), how);
  };
  auto outcome = relax::relax(stepper, restart, vesicle.model, config.stop, {}, controllers);
  return {std::move(outcome), stepper->state()};
}

/// Axisymmetric solution (reference/axisymmetric.csv), and how near a run has to come.
struct Reference {
  double energy;
  double volume_multiplier;
  double energy_tolerance;
  double multiplier_tolerance;
};

void expect_reference(const test::RelaxationResult& result, const Reference& reference) {
  EXPECT_EQ(result.outcome.status, relax::RunStatus::converged) << result.outcome.reason;
  EXPECT_NEAR(result.energy(), reference.energy, reference.energy_tolerance);
  EXPECT_NEAR(result.volume_multiplier(), reference.volume_multiplier,
              reference.multiplier_tolerance);
  EXPECT_GT(result.outcome.diagnostics.quality, 0.3);
  EXPECT_GE(result.outcome.mesh_changes.size(), 1U);
  const auto& errors = result.outcome.diagnostics.constraint_errors;
  for (const auto& error : errors.values) EXPECT_LT(std::abs(error.value_or(0)), 1e-10);
}

TEST(SlowAdaption, ReachesTable1) {
  expect_reference(run_adaptively("cigar_dumbbell", {}),
                   {test::table_1_energy, test::table_1_volume_multiplier, 8e-4, 2e-3});
}

TEST(SlowAdaption, ReachesTable1WithTheVariationalFlow) {
  expect_reference(run_adaptively("cigar_dumbbell", {"solver.scheme=variational"}),
                   {test::table_1_energy, test::table_1_volume_multiplier, 8e-4, 2e-3});
}

TEST(SlowAdaption, ReachesTable1WithThePapersMethods) {
  // The image of a sphere mesh replaces even the good mesh of the start.
  for (const auto& overrides : std::vector<std::vector<std::string>>{
           {"adaption.method=bisection"},
           {"adaption.method=conformal", "adaption.conformal_quality=0.6"}}) {
    expect_reference(run_adaptively("cigar_dumbbell", overrides),
                     {test::table_1_energy, test::table_1_volume_multiplier, 8e-4, 3e-3});
  }
}

TEST(SlowAdaption, ReachesHighLineTension) {
  const double energy = 116.842137;
  const double multiplier = -124.295708;
  expect_reference(run_adaptively("line_tension", {"shape.resolution=5"}),
                   {energy, multiplier, 2e-5 * energy, 2e-4 * -multiplier});
}

TEST(SlowAdaption, ReachesAThinNeck) {
  const double energy = 56.579056;
  const double multiplier = 18.933753;
  expect_reference(run_adaptively("neck", {}),
                   {energy, multiplier, 2e-5 * energy, 2e-4 * multiplier});
}

/// The minimiser on meshes that change, and outer iterations on the last of them.
test::RelaxationResult minimise_adaptively(const std::string& name,
                                           std::vector<std::string> overrides = {}) {
  overrides.emplace_back("solver.method=minimize");
  auto result = run_adaptively(name, std::move(overrides));
  EXPECT_FALSE(result.outcome.mesh_changes.empty());
  const long last_change = result.outcome.mesh_changes.back().step;
  EXPECT_LE(result.counts().steps - last_change, 15);
  EXPECT_NE(result.outcome.reason.find("a minimum"), std::string::npos) << result.outcome.reason;
  return result;
}

TEST(AdaptiveMinimisation, ReachesTable1) {
  const auto result = minimise_adaptively("cigar_dumbbell");
  expect_reference(result, {test::table_1_energy, test::table_1_volume_multiplier, 8e-4, 2e-3});
  EXPECT_EQ(result.state.time, static_cast<double>(result.counts().steps));
}

TEST(SlowAdaptiveMinimisation, ReachesHighLineTension) {
  const double energy = 116.842137;
  const double multiplier = -124.295708;
  expect_reference(minimise_adaptively("line_tension"),
                   {energy, multiplier, 3e-6 * energy, 2e-4 * -multiplier});
}

TEST(SlowAdaptiveMinimisation, ReachesAThinNeck) {
  const double energy = 56.579056;
  const double multiplier = 18.933753;
  expect_reference(minimise_adaptively("neck"),
                   {energy, multiplier, 4e-6 * energy, 2e-4 * multiplier});
}

TEST(SlowAdaptiveMinimisation, ReachesGaussianRigiditiesThatDiffer) {
  const double energy = 138.025586;
  const double multiplier = -137.844528;
  expect_reference(minimise_adaptively("gaussian_rigidity"),
                   {energy, multiplier, 5e-6 * energy, 2e-4 * -multiplier});
}

}  // namespace
}  // namespace vesica
