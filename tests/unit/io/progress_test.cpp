#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "fake_run.hpp"
#include "vesica/io/progress.hpp"

namespace vesica::io {
namespace {

constexpr const char* line_12 =
    "step 12  t 0.25  dt 1.3e-02  order 2  F 58.750000  v 3.0e-03  C 2.0e-09  q 0.500";

/// What is printed in a run of `steps` steps.
std::string printed(ProgressStyle style, long steps) {
  std::ostringstream out;
  Progress progress(out, style);
  const problem::State state = fake_state();
  const measure::Diagnostics measured = fake_diagnostics();
  for (long step = 0; step <= steps; ++step) {
    const solve::StepReport report = fake_report(step);
    progress.observe({state, report, measured});
  }
  const solve::StepReport last = fake_report(steps);
  progress.finish({state, last, measured}, fake_outcome(relax::RunStatus::converged));
  return out.str();
}

TEST(Progress, ALineTellsTimeStepEnergyVelocityErrorAndQuality) {
  const problem::State state = fake_state();
  const measure::Diagnostics measured = fake_diagnostics();
  const solve::StepReport report = fake_report(12);
  EXPECT_EQ(progress_line({state, report, measured}), line_12);
}

TEST(Progress, ALineOfAMinimisationTellsEvaluationsAndTheDistanceToTheMinimum) {
  const problem::State state = fake_state();
  const measure::Diagnostics measured = fake_diagnostics();
  solve::StepReport report = fake_report(12);
  report.counts.residuals = 71;
  report.gradient = 3.2e-4;
  const std::string line = progress_line({state, report, measured});
  EXPECT_TRUE(line.starts_with("step 12  evaluations 71  F ")) << line;
  EXPECT_NE(line.find("  distance 3.2e-04  C "), std::string::npos) << line;
}

constexpr const char* event_12 = "step 12  t 0.25  domains of phase 1: 2 -> 1";

TEST(Progress, AnEventHasALineOfItsOwn) {
  const relax::Event event{12, 0.25, "domains of phase 1: 2 -> 1"};
  EXPECT_EQ(event_line(event), event_12);
  const problem::State state = fake_state();
  const measure::Diagnostics measured = fake_diagnostics();
  const solve::StepReport report = fake_report(12);
  for (const auto& [style, text] :
       {std::pair{ProgressStyle::sparse, fmt::format("{}\n", event_12)},
        std::pair{ProgressStyle::rewriting, fmt::format("\r{}\x1b[K\n", event_12)},
        std::pair{ProgressStyle::none, std::string()}}) {
    std::ostringstream out;
    Progress(out, style).happened({state, report, measured}, event);
    EXPECT_EQ(out.str(), text);
  }
}

TEST(Progress, ATerminalHasOneLineThatIsRewritten) {
  const std::string text = printed(ProgressStyle::rewriting, 12);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 14);
  EXPECT_TRUE(text.ends_with(std::string("\r") + line_12 + "\x1b[K\n"));
}

TEST(Progress, APipeHasTheFirstEveryTenthAndTheLastStep) {
  const std::string text = printed(ProgressStyle::sparse, 12);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_TRUE(text.starts_with("step 0 "));
  EXPECT_NE(text.find("\nstep 10 "), std::string::npos);
  EXPECT_TRUE(text.ends_with(std::string(line_12) + "\n"));
}

TEST(Progress, APipeHasALineAfterFiveSeconds) {
  std::ostringstream out;
  Progress progress(out, ProgressStyle::sparse);
  const problem::State state = fake_state();
  const measure::Diagnostics measured = fake_diagnostics();
  solve::StepReport report = fake_report(0);
  for (const double seconds : {0.0, 4.0, 6.0, 8.0}) {
    report.seconds.total = seconds;
    progress.observe({state, report, measured});
    ++report.counts.steps;
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(Progress, IsSilentOnRequest) { EXPECT_EQ(printed(ProgressStyle::none, 12), ""); }

}  // namespace
}  // namespace vesica::io
