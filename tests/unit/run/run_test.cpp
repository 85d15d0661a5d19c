#include "vesica/run/run.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_reader.hpp"

namespace vesica::run {
namespace {

namespace fs = std::filesystem;

/// Stops after a step, asks for the damping 0.3 before, and counts what it is asked.
class StopAfter final : public relax::Controller {
 public:
  explicit StopAfter(long last) : last_(last) {}
  std::vector<relax::Request> respond(const relax::StepView& view) override {
    ++asked;
    if (view.report.counts.steps < last_) return {relax::SetDamping{0.3}};
    return {relax::Stop{relax::RunStatus::stopped, "that is enough"}};
  }
  int asked = 0;

 private:
  long last_;
};

/// Counts what it sees, and sends a signal after a step.
class Counter final : public relax::Observer {
 public:
  void observe(const relax::StepView& view) override {
    ++steps;
    damping = view.state.damping;
    if (view.report.counts.steps == signal_after) signal = SIGTERM;
  }
  void finish(const relax::StepView&, const relax::Outcome&) override { ++finishes; }
  int steps = 0;
  int finishes = 0;
  double damping = 0;
  long signal_after = -1;
  std::atomic<int> signal{0};
};

/// A new mesh after the second step.
class RemeshOnce final : public relax::Controller {
 public:
  std::vector<relax::Request> respond(const relax::StepView& view) override {
    if (view.report.counts.steps != 2) return {};
    adapt::SizeFieldOptions sizes;
    sizes.max_size = 0.3;
    return {relax::Remesh{sizes, 1000, "the test wants it"}};
  }
};

class RunTest : public ::testing::Test {
 protected:
  /// A coarse ellipsoid with loose tolerances, and `out` as its folder.
  RunTest() {
    config_.shape.kind = shapes::ShapeKind::ellipsoid;
    config_.shape.semi_axes = {1.4, 0.9, 0.9};
    config_.shape.resolution = 2;
    config_.solver.rtol = 1e-2;
    config_.stop.normal_velocity = 1e-2;
    config_.output.directory = (temporary_.path() / "out").string();
    without_files_.writes_files = false;
  }

  [[nodiscard]] bool nothing_is_written() const { return fs::is_empty(temporary_.path()); }

  /// The message of the ConfigError of a run.
  [[nodiscard]] std::string refusal(const Options& options) const {
    try {
      (void)run(config_, options);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no ConfigError";
  }

  /// A case for which no consistent initial values exist.
  setup::Case impossible_case() {
    config_.phase.emplace().kind = phase::PhaseKind::caps;
    config_.material.interface_width = 0.5;
    setup::Case vesicle = setup::make_case(config_);
    vesicle.start.values.order_parameter[3] = 1e200;
    return vesicle;
  }

  test::TemporaryFolder temporary_;
  config::RunConfig config_;
  Options without_files_;
};

TEST_F(RunTest, WithoutFilesReturnsTheEquilibriumAndWritesNothing) {
  const Result result = run(config_, without_files_);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::converged);
  EXPECT_EQ(result.verdict.method, "ida");
  EXPECT_EQ(result.verdict.num_nodes, result.state.triangulation->num_nodes());
  EXPECT_EQ(result.verdict.time, result.state.time);
  EXPECT_GT(result.state.time, 0);
  EXPECT_TRUE(nothing_is_written());
}

TEST_F(RunTest, ReturnsTheWarningsOfTheCase) {
  config_.shape.number_of_tips = 4;
  const Result result = run(config_, without_files_);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("shape.number_of_tips means nothing"), std::string::npos);
}

TEST_F(RunTest, WritesFilesThatReadBackAsItsResult) {
  const Result result = run(config_);
  for (const std::string name : {"verdict.json", "case.toml", "trajectory.h5", "trajectory.xdmf"})
    EXPECT_TRUE(fs::exists(temporary_.path() / "out" / name)) << name;
  const io::FinishedRun finished = io::read_run(config_.output.directory);
  EXPECT_EQ(finished.state.values.positions, result.state.values.positions);
  EXPECT_EQ(finished.verdict.outcome.diagnostics.energy.total(),
            result.verdict.outcome.diagnostics.energy.total());
}

TEST_F(RunTest, ReplacesAnOlderRunOnlyWhenToldTo) {
  config_.stop.max_steps = 1;
  Options options;
  (void)run(config_, options);
  EXPECT_NE(refusal(options).find("already holds a run"), std::string::npos) << refusal(options);
  options.overwrites = true;
  EXPECT_EQ(run(config_, options).verdict.outcome.status, relax::RunStatus::step_limit);
}

TEST_F(RunTest, RefusesWrongOptionsBeforeAnythingIsWrittenAndTellsTheirPlace) {
  config_.damping.minimum = 3;
  config_.damping.maximum = 2;
  config_.places["damping.minimum"] = "my.toml:7:11";
  EXPECT_EQ(refusal({}).find("my.toml:7:11: damping.minimum = 3"), 0U) << refusal({});
  EXPECT_TRUE(nothing_is_written());
}

TEST_F(RunTest, GoesOnWithAnOlderRun) {
  config_.stop.max_steps = 3;
  const Result first = run(config_);
  Options options = without_files_;
  options.resumed = config_.output.directory;
  const Result second = run(config_, options);
  EXPECT_GT(second.state.time, first.state.time);
}

/// Throws after the second step.
class Thrower final : public relax::Observer {
 public:
  void observe(const relax::StepView& view) override {
    if (view.report.counts.steps == 2) throw std::bad_alloc();
  }
};

TEST_F(RunTest, AnExceptionLeavesARunWithAVerdictThatGoesOn) {
  Thrower thrower;
  Options options;
  options.observers = {&thrower};
  EXPECT_THROW((void)run(config_, options), std::bad_alloc);
  const io::FinishedRun broken = io::read_run(config_.output.directory);
  EXPECT_EQ(broken.verdict.outcome.status, relax::RunStatus::numerical_failure);
  EXPECT_EQ(broken.verdict.outcome.reason, "std::bad_alloc");
  options.observers = {};
  options.resumed = config_.output.directory;
  EXPECT_EQ(run(config_, options).verdict.outcome.status, relax::RunStatus::converged);
}

TEST_F(RunTest, GoesOnInItsFolderWithOneRecordOfTheWholeRun) {
  config_.stop.max_steps = 3;
  config_.output.every_steps = 1;
  const Result first = run(config_);
  Options options;
  options.resumed = config_.output.directory;
  options.overwrites = true;
  const Result second = run(config_, options);
  EXPECT_EQ(second.verdict.outcome.report.counts.steps, 6);
  EXPECT_EQ(second.verdict.run, first.verdict.run);
  EXPECT_EQ(second.verdict.outcome.initial_quality, first.verdict.outcome.initial_quality);
  const io::FinishedRun whole = io::read_run(config_.output.directory);
  EXPECT_EQ(whole.history.step, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(whole.verdict.outcome.report.counts.steps, 6);
  EXPECT_EQ(whole.state.time, second.state.time);
}

TEST_F(RunTest, ARunIsNotContinuedFromAStateThatAnotherOneHasLeftBehind) {
  config_.stop.max_steps = 2;
  (void)run(config_);
  Options options;
  options.resumed = config_.output.directory;
  const setup::Case vesicle = prepare(config_, options);
  (void)run(config_, vesicle, options);
  EXPECT_THROW((void)run(config_, vesicle, options), ConfigError);
}

TEST_F(RunTest, EndsWhenAControllerOfTheCallerWantsIt) {
  StopAfter controller(3);
  Counter observer;
  without_files_.controllers = {&controller};
  without_files_.observers = {&observer};
  const Result result = run(config_, without_files_);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::stopped);
  EXPECT_EQ(result.verdict.outcome.reason, "that is enough");
  EXPECT_EQ(controller.asked, 4) << "the start and three steps";
  EXPECT_EQ(observer.steps, 4);
  EXPECT_EQ(observer.finishes, 1);
  EXPECT_EQ(observer.damping, 0.3) << "the caller's damping goes before the usual one";
}

TEST_F(RunTest, IsInterruptedBeforeAnythingElseThatTheCallerWants) {
  StopAfter controller(2);
  Counter observer;
  observer.signal_after = 2;
  without_files_.controllers = {&controller};
  without_files_.observers = {&observer};
  without_files_.interrupt = &observer.signal;
  const relax::Outcome outcome = run(config_, without_files_).verdict.outcome;
  EXPECT_EQ(outcome.status, relax::RunStatus::interrupted);
  EXPECT_EQ(outcome.reason, "SIGTERM received after step 2");
  EXPECT_EQ(relax::exit_status(outcome), 143);
}

TEST_F(RunTest, ChangesTheMeshForAControllerOfTheCaller) {
  RemeshOnce controller;
  without_files_.controllers = {&controller};
  config_.stop.max_steps = 3;
  const Result result = run(config_, without_files_);
  ASSERT_EQ(result.verdict.outcome.mesh_changes.size(), 1U);
  EXPECT_EQ(result.verdict.outcome.mesh_changes[0].nodes_after, result.verdict.num_nodes);
}

TEST_F(RunTest, ChangesTheMeshWhereTheConfigurationWantsIt) {
  config_.adaption.enabled = true;
  const Result result = run(config_, without_files_);
  EXPECT_GT(result.verdict.outcome.mesh_changes.size(), 0U);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::converged);
}

TEST_F(RunTest, WritesProgressToTheStreamOfTheCaller) {
  std::ostringstream progress;
  without_files_.progress = &progress;
  config_.stop.max_steps = 2;
  (void)run(config_, without_files_);
  EXPECT_EQ(progress.str().find("step 0  t 0"), 0U) << progress.str();
  EXPECT_NE(progress.str().find("\nstep 2  t "), std::string::npos) << progress.str();
}

TEST_F(RunTest, AStartWithoutConsistentValuesIsInTheVerdict) {
  const setup::Case vesicle = impossible_case();
  Counter observer;
  std::ostringstream progress;
  without_files_.observers = {&observer};
  without_files_.progress = &progress;
  const Result result = run(config_, vesicle, without_files_);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::numerical_failure);
  EXPECT_EQ(result.verdict.outcome.reason.find("initial values: "), 0U);
  EXPECT_TRUE(std::isnan(result.verdict.outcome.diagnostics.energy.total()));
  EXPECT_EQ(result.state.values.positions, vesicle.start.values.positions);
  EXPECT_EQ(observer.steps, 0);
  EXPECT_EQ(observer.finishes, 1);
  EXPECT_EQ(progress.str(), "");
  EXPECT_TRUE(nothing_is_written());
}

TEST_F(RunTest, AFailedStartLeavesTheFilesOfARunWhoseEnergyIsNoNumber) {
  (void)run(config_, impossible_case());
  const io::FinishedRun finished = io::read_run(config_.output.directory);
  ASSERT_EQ(finished.history.energy.size(), 1U);
  EXPECT_TRUE(std::isnan(finished.history.energy[0]));
  EXPECT_EQ(relax::exit_status(finished.verdict.outcome), 3);
  EXPECT_TRUE(std::isnan(finished.verdict.outcome.diagnostics.energy.total()));
}

}  // namespace
}  // namespace vesica::run
