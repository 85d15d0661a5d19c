#pragma once

#include <gtest/gtest.h>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/scales.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/observer.hpp"

namespace vesica::relax {

/// A run at a step, all of it made up by the test.
class ControllerTest : public ::testing::Test {
 protected:
  [[nodiscard]] StepView view() const { return {state_, report_, diagnostics_}; }
  StepView view_at(long step) {
    report_.counts.steps = step;
    return view();
  }

  model::Model model_;
  problem::Scales scales_;
  problem::State state_;
  solve::StepReport report_;
  measure::Diagnostics diagnostics_;
};

}  // namespace vesica::relax
