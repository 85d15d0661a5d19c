#include "vesica/relax/damping_controller.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "controller_test.hpp"
#include "vesica/core/error.hpp"

namespace vesica::relax {
namespace {

/// What a controller makes of velocity norms and the present damping.
class DampingTest : public ControllerTest {
 protected:
  std::optional<double> answer(DampingController& controller, double alpha, double normal,
                               double tangential, long step = 5) {
    state_.damping = alpha;
    diagnostics_.velocity = {normal, normal, tangential};
    const auto requests = controller.respond(view_at(step));
    if (requests.empty()) return std::nullopt;
    return std::get<SetDamping>(requests.at(0)).alpha;
  }

  static DampingOptions of_kind(DampingKind kind) {
    DampingOptions options;
    options.kind = kind;
    return options;
  }
};

TEST_F(DampingTest, OfKindSpeedIsInverseToTheNormalVelocity) {
  DampingController controller({}, {});
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 5 / 1.2, 0), 1.2);
}

TEST_F(DampingTest, OfKindSpeedChangesByAtMostTheFactor) {
  DampingController controller({}, {});
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 1e-6, 0), 2);
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 1e6, 0), 0.5);
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 0, 0), 2);
}

TEST_F(DampingTest, OfKindSpeedStaysWithinItsLimits) {
  DampingController controller({}, {});
  EXPECT_DOUBLE_EQ(*answer(controller, 8, 1e-6, 0), 10);
  EXPECT_DOUBLE_EQ(*answer(controller, 0.015, 1e6, 0), 0.01);
  EXPECT_FALSE(answer(controller, 10, 1e-6, 0).has_value());  // nothing to change
}

TEST_F(DampingTest, OfKindRatioKeepsTheTangentialVelocityWithinTheThresholds) {
  DampingController controller(of_kind(DampingKind::ratio), {});
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 1, 0.6), 2);
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 1, 0.05), 0.5);
  EXPECT_FALSE(answer(controller, 1, 1, 0.3).has_value());
}

TEST_F(DampingTest, OfKindPaperTakesThePapersConstants) {
  DampingController controller(of_kind(DampingKind::paper), {});
  EXPECT_DOUBLE_EQ(*answer(controller, 77, 1, 1, 0), 1e-4);
  EXPECT_DOUBLE_EQ(*answer(controller, 1e-4, 1, 0.6), 1e-3);
  EXPECT_DOUBLE_EQ(*answer(controller, 2e-6, 1, 0.05), 1e-6);
}

TEST_F(DampingTest, OfKindFixedKeepsItsStartEvenOutsideTheLimits) {
  auto options = of_kind(DampingKind::fixed);
  options.initial = 50;
  DampingController controller(options, {});
  EXPECT_DOUBLE_EQ(*answer(controller, 1, 1, 1, 0), 50);
  EXPECT_FALSE(answer(controller, 50, 1e-3, 7).has_value());
}

TEST_F(DampingTest, StartsAtItsInitialValueWhateverTheVelocity) {
  DampingController controller({}, {});
  EXPECT_DOUBLE_EQ(*answer(controller, 0.3, 600, 10, 0), 1);
}

TEST_F(DampingTest, IsMeasuredInTheUnitsOfTheCase) {
  const problem::Scales scales{10, 20};  // damping 100 / 20, speed 10^2 / (10^4 / 20)
  DampingController controller({}, scales);
  EXPECT_DOUBLE_EQ(*answer(controller, 77, 1, 0, 0), 5);
  EXPECT_DOUBLE_EQ(*answer(controller, 5, 5 / 1.2 * 0.2, 0), 1.2 * 5);
}

void expect_refused(const DampingOptions& options, const std::string& text) {
  try {
    (void)resolved_damping(options);
    FAIL() << "nothing thrown; expected: " << text;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(DampingOptionsCheck, RefusesLimitsInTheWrongOrder) {
  DampingOptions options;
  options.minimum = 20;
  expect_refused(options, "damping.minimum = 20: must be <= damping.maximum = 10");
}

TEST(DampingOptionsCheck, RefusesAStartOutsideTheLimits) {
  DampingOptions options;
  options.initial = 11;
  expect_refused(options, "damping.initial = 11: must lie between");
}

TEST(DampingOptionsCheck, RefusesThresholdsInTheWrongOrder) {
  DampingOptions options;
  options.lower_ratio = 0.5;
  expect_refused(options, "damping.lower_ratio = 0.5: must be < damping.upper_ratio = 0.5");
}

}  // namespace
}  // namespace vesica::relax
