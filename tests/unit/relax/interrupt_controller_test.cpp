#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <variant>

#include "vesica/relax/interrupt_controller.hpp"

namespace vesica::relax {
namespace {

TEST(InterruptController, AsksToStopOnceASignalHasArrived) {
  const problem::State state;
  solve::StepReport report;
  report.counts.steps = 7;
  const measure::Diagnostics measured;
  std::atomic<int> signal{0};
  InterruptController controller(signal);
  EXPECT_TRUE(controller.respond({state, report, measured}).empty());
  signal = SIGTERM;
  const std::vector<Request> requests = controller.respond({state, report, measured});
  ASSERT_EQ(requests.size(), 1U);
  const Stop& stop = std::get<Stop>(requests.front());
  EXPECT_EQ(stop.status, RunStatus::interrupted);
  EXPECT_EQ(stop.signal, SIGTERM);
  EXPECT_EQ(stop.reason, "SIGTERM received after step 7");
  EXPECT_EQ(controller.respond_to_failure({state, report, measured}).size(), 1U);
}

}  // namespace
}  // namespace vesica::relax
