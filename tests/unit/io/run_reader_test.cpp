#include "vesica/io/run_reader.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "flat_json.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/io/verdict_files.hpp"
#include "written_run.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

std::string io_error_of(const fs::path& folder) {
  try {
    (void)read_run(folder);
  } catch (const IoError& error) {
    return error.what();
  }
  return "no IoError";
}

TEST(RunReader, ReadsTheFinalStateBack) {
  const test::TemporaryFolder folder;
  write_fake_run(folder.path(), relax::RunStatus::converged);
  const FinishedRun run = read_run(folder.path());
  problem::State expected = fake_state();
  for (int step = 0; step <= 12; ++step) expected.values.positions *= 1.001;
  EXPECT_EQ(run.config.title, "made up");
  EXPECT_TRUE(run.model.is_two_phase);
  EXPECT_EQ(run.state.time, 1.5);
  EXPECT_EQ(run.state.damping, 0.75);
  EXPECT_EQ(run.state.triangulation->triangles()[3], expected.triangulation->triangles()[3]);
  EXPECT_EQ(run.state.values.positions, expected.values.positions);
  EXPECT_EQ(run.state.values.mean_curvature, expected.values.mean_curvature);
  EXPECT_EQ(run.state.values.order_parameter, expected.values.order_parameter);
  EXPECT_EQ(run.state.rates.positions, expected.rates.positions);
  EXPECT_EQ(run.state.values.multipliers.of<model::Volume>(), 27.5);
  EXPECT_EQ(run.state.values.multipliers.of<model::Area>(), -9.25);
  EXPECT_EQ(run.state.values.multipliers.of<model::PhaseDifference>(), std::nullopt);
}

TEST(RunReader, AResumedCaseKeepsTheOriginOfTheRun) {
  const test::TemporaryFolder folder;
  write_fake_run(folder.path(), relax::RunStatus::interrupted, SIGINT);
  config::RunConfig config;
  config.phase.emplace();
  const setup::Case resumed = resumed_case(config, folder.path());
  const setup::Origin expected = setup::case_of(config, fake_state()).origin;
  EXPECT_EQ(resumed.origin.measures.volume(), expected.measures.volume());
  EXPECT_EQ(resumed.origin.measures.area(), expected.measures.area());
  EXPECT_EQ(resumed.origin.measures.phase_difference(), expected.measures.phase_difference());
  EXPECT_EQ(resumed.origin.is_sphere, expected.is_sphere);
  EXPECT_EQ(resumed.model.targets.of<model::Volume>()->last(), expected.measures.volume());
  EXPECT_EQ(resumed.start.time, 1.5);
}

/// The last step of a run at rest is as long as it could be, and the final solve has other rates.
TEST(RunReader, OnlyARunInMotionGoesOnWithItsLastStep) {
  for (const auto status : {relax::RunStatus::step_limit, relax::RunStatus::converged}) {
    const test::TemporaryFolder folder;
    write_fake_run(folder.path(), status);
    config::RunConfig config = recorded_config(folder.path(), {});
    const bool moves = status == relax::RunStatus::step_limit;
    EXPECT_EQ(resumed_case(config, folder.path()).resumed->step_size, moves ? 0.0125 : 0);
    config.stop.max_steps = 5;
    EXPECT_EQ(resumed_case(config, folder.path()).resumed->step_size, moves ? 0.0125 : 0);
    config.solver.rtol = 1e-4;
    EXPECT_EQ(resumed_case(config, folder.path()).resumed->step_size, 0);
  }
}

TEST(RunReader, ReadsTheVerdictBackInEveryNumber) {
  const test::TemporaryFolder folder;
  const relax::Verdict verdict = write_fake_run(folder.path(), relax::RunStatus::converged);
  write_text_file(folder.path() / "again.json", io::to_json(read_run(folder.path()).verdict));
  const auto written = test::flat_json(folder.path() / "verdict.json");
  const auto again = test::flat_json(folder.path() / "again.json");
  EXPECT_EQ(again.at("/status"), "converged");
  EXPECT_EQ(again.at("/reason"), verdict.outcome.reason);
  EXPECT_EQ(again.at("/method"), "ida");
  EXPECT_EQ(again.size(), written.size());
  EXPECT_GT(written.size(), 50U);
  for (const auto& [pointer, value] : written.items()) {
    const auto& other = again.at(pointer);
    ASSERT_EQ(other.type(), value.type()) << pointer;
    if (!value.is_number_float()) {
      EXPECT_EQ(other, value) << pointer;
    } else {
      EXPECT_DOUBLE_EQ(other.get<double>(), value.get<double>()) << pointer;
    }
  }
}

TEST(RunReader, ReadsTheEnergyOfEveryStep) {
  const test::TemporaryFolder folder;
  write_fake_run(folder.path(), relax::RunStatus::step_limit);
  const FinishedRun run = read_run(folder.path());
  EXPECT_EQ(run.history.energy, std::vector<double>(13, 58.75));
  EXPECT_EQ(run.history.seconds, std::vector<double>(13, 0.5));
  EXPECT_EQ(run.history.step.back(), 12);
  EXPECT_EQ(read_history(folder.path()).energy, run.history.energy);
}

TEST(RunReader, KeepsTheExitStatusOfTheRun) {
  const test::TemporaryFolder folder;
  write_fake_run(folder.path(), relax::RunStatus::interrupted, SIGTERM);
  EXPECT_EQ(exit_status(read_run(folder.path()).verdict.outcome), 143);
}

TEST(RunReader, AFolderWithoutAFinishedRunIsAnIoError) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(io_error_of(folder.path() / "none"),
            (folder.path() / "none").string() + ": no such folder");
  EXPECT_NE(io_error_of(folder.path()).find("holds no finished run (trajectory.h5 is missing)"),
            std::string::npos);
  std::ofstream(folder.path() / "trajectory.part.h5") << "x";
  EXPECT_NE(io_error_of(folder.path()).find("the run goes on or broke off"), std::string::npos);
}

/// As a kill leaves it between the verdict in the record and the names of the files.
TEST(RunReader, AnEndThatWasInterruptedIsCompleted) {
  for (const bool has_name : {false, true}) {
    const test::TemporaryFolder folder;
    const relax::Verdict verdict = write_fake_run(folder.path(), relax::RunStatus::converged);
    if (!has_name)
      fs::rename(folder.path() / "trajectory.h5", folder.path() / "trajectory.part.h5");
    for (const char* name : {"verdict.json", "case.toml", "trajectory.xdmf"})
      fs::remove(folder.path() / name);
    EXPECT_NE(io_error_of(folder.path()).find("vesica-relax --resume completes it"),
              std::string::npos);
    const config::RunConfig config = recorded_config(folder.path(), {});
    const auto conclusion = find_conclusion(config, folder.path());
    ASSERT_TRUE(conclusion);
    EXPECT_EQ(conclusion->outcome.reason, verdict.outcome.reason);
    EXPECT_EQ(read_run(folder.path()).verdict.run, verdict.run);
    EXPECT_TRUE(fs::exists(folder.path() / "trajectory.xdmf"));
    EXPECT_FALSE(fs::exists(folder.path() / "trajectory.part.h5"));
  }
}

TEST(RunReader, DamagedFilesAreIoErrorsThatNameThem) {
  const test::TemporaryFolder folder;
  write_fake_run(folder.path(), relax::RunStatus::converged);
  const auto whole = test::flat_json(folder.path() / "verdict.json").unflatten();
  std::ofstream(folder.path() / "verdict.json") << "{\"status\": ";
  EXPECT_NE(io_error_of(folder.path()).find("verdict.json: is no JSON"), std::string::npos);
  std::ofstream(folder.path() / "verdict.json") << "{\"status\": \"converged\"}";
  EXPECT_NE(io_error_of(folder.path()).find("verdict.json: /reason is missing"), std::string::npos);
  const auto error_with = [&](const std::string& pointer, const nlohmann::json& value) {
    auto damaged = whole;
    damaged[nlohmann::json::json_pointer(pointer)] = value;
    std::ofstream(folder.path() / "verdict.json") << damaged;
    return io_error_of(folder.path());
  };
  for (const auto& [pointer, value, message] :
       std::vector<std::tuple<std::string, nlohmann::json, std::string>>{
           {"/status", "well", "verdict.json: /status \"well\" is not known"},
           {"/reason", 1, "verdict.json: /reason must be a text"},
           {"/mesh", 1, "verdict.json: /mesh/nodes is missing"},
           {"/shape/volume", "x", "verdict.json: /shape/volume must be a number or null"},
           {"/counts/steps", 1.5, "verdict.json: /counts/steps must be a whole number"},
           {"/domains/phase_1", 1.5, "verdict.json: /domains/phase_1 must be a whole number"},
           {"/domains/areas/phase_2", 1, "/domains/areas/phase_2 must be an array"},
           {"/domains/areas/phase_1", {1}, "verdict.json: /domains/areas/phase_1/1 is missing"},
           {"/events", nullptr, "verdict.json: /events must be an array"},
           {"/events/0/what", 1, "verdict.json: /events/0/what must be a text"},
           {"/polish/iterations", 1.5, "/polish/iterations must be a whole number"}})
    EXPECT_NE(error_with(pointer, value).find(message), std::string::npos)
        << error_with(pointer, value);
  std::ofstream(folder.path() / "trajectory.h5") << "no HDF5";
  EXPECT_NE(io_error_of(folder.path()).find("trajectory.h5: / cannot be read, H5Fopen failed"),
            std::string::npos);
}

}  // namespace
}  // namespace vesica::io
