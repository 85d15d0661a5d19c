#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "vesica/run/run.hpp"

namespace vesica::run {
namespace {

/// A two-phase prolate in units of length and energy of its own.
Result run_in(double length, double energy, solve::Method method) {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::ellipsoid;
  config.shape.semi_axes = {1.4 * length, length, length};
  config.shape.resolution = 4;
  config.phase.emplace().kind = phase::PhaseKind::caps;
  config.material.bending_rigidity = {energy, energy};
  config.material.line_tension = model::Schedule(2 * energy / length);
  config.material.interface_width = model::Schedule(0.5 * length);
  config.material.kinetic_coefficient = model::Schedule(0.1 * length);
  config.solver.method = method;
  return run(config, {.writes_files = false});
}

double reduced_energy(const Result& result, double energy) {
  return result.verdict.outcome.diagnostics.energy.total() / energy;
}

class Units : public ::testing::TestWithParam<std::pair<double, double>> {};

/// Powers of two change no digit, so the runs are the same to the last bit.
TEST_P(Units, OfPowersOfTwoChangeNothing) {
  const auto [length, energy] = GetParam();
  for (const solve::Method method : {solve::Method::ida, solve::Method::minimize}) {
    const Result unit = run_in(1, 1, method);
    const double l = std::exp2(std::round(std::log2(length)));
    const double e = std::exp2(std::round(std::log2(energy)));
    const Result other = run_in(l, e, method);
    ASSERT_EQ(unit.verdict.outcome.status, relax::RunStatus::converged);
    EXPECT_EQ(other.verdict.outcome.status, relax::RunStatus::converged)
        << other.verdict.outcome.reason;
    const auto& counts = unit.verdict.outcome.report.counts;
    const auto& there = other.verdict.outcome.report.counts;
    EXPECT_EQ(there.steps, counts.steps) << name_of(method);
    EXPECT_EQ(there.newton, counts.newton) << name_of(method);
    EXPECT_EQ(there.residuals, counts.residuals) << name_of(method);
    EXPECT_NEAR(reduced_energy(other, e) / reduced_energy(unit, 1), 1, 1e-12);
  }
}

/// Other units round differently: the minimiser takes the same steps, and the flow, whose
/// error control can decide otherwise at its threshold, nearly as many.
TEST_P(Units, OfOtherNumbersChangeNoMoreThanRoundingDoes) {
  const auto [length, energy] = GetParam();
  for (const solve::Method method : {solve::Method::ida, solve::Method::minimize}) {
    const Result unit = run_in(1, 1, method);
    const Result other = run_in(length, energy, method);
    EXPECT_EQ(other.verdict.outcome.status, relax::RunStatus::converged)
        << other.verdict.outcome.reason;
    const auto steps = static_cast<double>(unit.verdict.outcome.report.counts.steps);
    const auto there = static_cast<double>(other.verdict.outcome.report.counts.steps);
    EXPECT_NEAR(there, steps, method == solve::Method::ida ? 0.25 * steps : 0.0);
    EXPECT_NEAR(reduced_energy(other, energy) / reduced_energy(unit, 1), 1,
                method == solve::Method::ida ? 1e-5 : 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(LengthAndEnergy, Units,
                         ::testing::Values(std::pair{1e-9, 4e-20}, std::pair{1e-3, 1.0},
                                           std::pair{1.0, 1e6}, std::pair{1e3, 1.0},
                                           std::pair{1e3, 4e-20}));

}  // namespace
}  // namespace vesica::run
