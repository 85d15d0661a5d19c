#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "observed_order.hpp"
#include "relaxation_cases.hpp"
#include "vesica/solve/polish.hpp"

namespace vesica {
namespace {

/// Relaxes the weak form, polished, and returns the energy of the nearest equilibrium of the
/// discrete energy on the same nodes minus that of the weak form.
double gap(const test::RelaxationCase& start) {
  solve::SolverOptions options;
  options.polish = true;
  const auto weak = test::run_case(start, options);
  EXPECT_EQ(weak.outcome.status, relax::RunStatus::converged) << weak.outcome.reason;
  const auto minimum =
      solve::find_equilibrium({}, start.model, weak.state, weak.state.values.positions);
  EXPECT_TRUE(minimum.report.is_converged);
  EXPECT_GT(minimum.report.curvature.value, 0);
  return minimum.energy.total() - weak.energy();
}

test::RelaxationCase prolate(int resolution) {
  const double pi = std::numbers::pi;
  return test::single_phase_case(test::make_ellipsoid({1.6, 0.8, 0.8}, resolution),
                                 0.8 * 4 * pi / 3, 4 * pi);
}

TEST(SchemeGap, OfTheDumbbellFallsAtOrderTwoAndAHalf) {
  const double coarse = gap(test::table_1_case(4));
  const double middle = gap(test::table_1_case(6));
  const double fine = gap(test::table_1_case(8));
  std::printf("gap %g %g %g\n", coarse, middle, fine);
  EXPECT_GT(coarse, 1e-4);
  EXPECT_GT(test::observed_order(coarse, middle, 1.5), 2.5);
  EXPECT_GT(test::observed_order(middle, fine, 8.0 / 6), 2.5);
}

TEST(SchemeGap, OfTheProlateFallsAtOrderTwoAndAHalf) {
  const double coarse = gap(prolate(4));
  const double fine = gap(prolate(8));
  std::printf("gap %g %g\n", coarse, fine);
  EXPECT_GT(coarse, 1e-5);
  EXPECT_GT(test::observed_order(coarse, fine, 2), 2.5);
}

}  // namespace
}  // namespace vesica
