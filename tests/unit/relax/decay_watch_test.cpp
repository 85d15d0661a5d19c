#include "vesica/relax/decay_watch.hpp"

#include <gtest/gtest.h>

#include "controller_test.hpp"

namespace vesica::relax {
namespace {

class DecayWatchTest : public ControllerTest {
 protected:
  DecayWatchTest() { diagnostics_.constraint_errors = {}; }

  /// Whether the watch has had enough after a step with this energy.
  bool sees(DecayWatch& watch, double energy) {
    state_.time += 1;
    state_.damping = energy;  // to tell the states apart
    diagnostics_.energy = {};
    diagnostics_.energy.values[0] = energy;
    return watch.has_decayed(view());
  }
};

TEST_F(DecayWatchTest, KeepsTheStateOfLeastEnergyWhereItRisesForTenSteps) {
  DecayWatch watch(model_);
  EXPECT_FALSE(sees(watch, 100));
  EXPECT_FALSE(sees(watch, 90));
  for (int step = 1; step < 10; ++step) EXPECT_FALSE(sees(watch, 92)) << step;
  EXPECT_TRUE(sees(watch, 92));
  EXPECT_EQ(watch.best().damping, 90);
  EXPECT_EQ(watch.best().time, state_.time);
  EXPECT_NE(watch.stop().reason.find("rose from 90 to 92"), std::string::npos);
  EXPECT_EQ(watch.stop().status, RunStatus::unresolved);
}

TEST_F(DecayWatchTest, ForgivesSmallAndShortRises) {
  DecayWatch watch(model_);
  (void)sees(watch, 90);
  for (int step = 0; step < 50; ++step) EXPECT_FALSE(sees(watch, 90.8));
  for (int step = 0; step < 50; ++step) EXPECT_FALSE(sees(watch, step % 9 == 0 ? 90 : 95));
}

TEST_F(DecayWatchTest, LooksAtFlowsWhoseModelRests) {
  model_.material.line_tension = model::Schedule::ramp(1, 2, 0, 1e6);
  DecayWatch watch(model_);
  (void)sees(watch, 90);
  for (int step = 0; step < 50; ++step) EXPECT_FALSE(sees(watch, 95));
  model_.material.line_tension = 1;
  report_.gradient = 1;
  for (int step = 0; step < 50; ++step) EXPECT_FALSE(sees(watch, 95));
}

}  // namespace
}  // namespace vesica::relax
