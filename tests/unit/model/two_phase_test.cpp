#include "vesica/model/two_phase.hpp"

#include <gtest/gtest.h>

#include "vesica/core/dual.hpp"

namespace vesica::model {
namespace {

TEST(PhaseIndicator, IsPlusOneInPhase1AndMinusOneInPhase2) {
  EXPECT_EQ(phase_indicator(1.0), 1);
  EXPECT_EQ(phase_indicator(-1.0), -1);
  EXPECT_EQ(phase_indicator(0.0), 0);
  EXPECT_DOUBLE_EQ(phase_indicator(0.5), 0.6875);
}

TEST(PhaseIndicator, StaysAtItsBoundsOutside) {
  for (const double c : {1.0, 1.001, 4.0}) {
    EXPECT_EQ(phase_indicator(c), 1);
    EXPECT_EQ(phase_indicator(-c), -1);
    EXPECT_EQ(phase_indicator_derivative(c), 0);
    EXPECT_EQ(phase_indicator_derivative(-c), 0);
  }
}

TEST(PhaseIndicator, HasItsDerivative) {
  for (const double c : {-1.2, -0.9, -0.1, 0.0, 0.6, 0.999, 1.3}) {
    EXPECT_NEAR(phase_indicator(Dual<1>::input(c, 0)).derivatives[0], phase_indicator_derivative(c),
                1e-15);
  }
  EXPECT_EQ(phase_indicator_derivative(0.0), 1.5);
}

TEST(DoubleWell, IsZeroInThePhasesAndOneHalfBetween) {
  EXPECT_EQ(double_well(1.0), 0);
  EXPECT_EQ(double_well(-1.0), 0);
  EXPECT_EQ(double_well(0.0), 0.5);
}

TEST(DoubleWell, HasItsDerivative) {
  for (const double c : {-1.2, -0.9, -0.1, 0.6, 0.999, 1.3}) {
    EXPECT_NEAR(double_well(Dual<1>::input(c, 0)).derivatives[0], double_well_derivative(c), 1e-14);
    EXPECT_NE(double_well_derivative(c), 0);
  }
}

TEST(Interpolation, TakesTheConstantsOfThePhasesAndTheirMeanBetween) {
  constexpr PhasePair k{3.0, 1.0};
  EXPECT_EQ(interpolate(k, 1.0), 3);
  EXPECT_EQ(interpolate(k, 1.5), 3);
  EXPECT_EQ(interpolate(k, -1.0), 1);
  EXPECT_EQ(interpolate(k, 0.0), 2);
  EXPECT_DOUBLE_EQ(interpolate(k, 0.5), 2.6875);
}

TEST(Interpolation, HasItsDerivative) {
  constexpr PhasePair k{3.0, 1.0};
  for (const double c : {-1.2, -0.9, 0.0, 0.6, 1.3}) {
    EXPECT_NEAR(interpolate(k, Dual<1>::input(c, 0)).derivatives[0], interpolate_derivative(k, c),
                1e-15);
  }
  EXPECT_EQ(interpolate_derivative(k, 0.0), 1.5);
}

TEST(Interpolation, OfEqualConstantsIsConstant) {
  constexpr PhasePair k{0.7, 0.7};
  for (const double c : {-1.2, 0.3, 1.0}) {
    EXPECT_EQ(interpolate(k, c), 0.7);
    EXPECT_EQ(interpolate_derivative(k, c), 0);
  }
}

}  // namespace
}  // namespace vesica::model
