#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/trajectory_writer.hpp"
#include "written_file.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

TEST(TrajectoryWriter, WritesFramesSeriesConfigurationAndOutcome) {
  const test::TemporaryFolder folder;
  FakeRun run;
  run.config.phase.emplace();
  run.config.title = "a test";
  {
    TrajectoryWriter writer(folder.path(), run.config, {});
    for (long step = 0; step <= 7; ++step) run.observe(writer, step);
    run.finish(writer);
  }
  const ReadableFile file(folder.path() / "trajectory.h5");
  const auto triangles = file.read<std::int32_t>("/meshes/000000/triangles", H5T_NATIVE_INT32);
  EXPECT_EQ(file.shape("/meshes/000000/triangles"), (std::vector<hsize_t>{8, 6}));
  EXPECT_EQ((std::vector<std::int32_t>(triangles.begin(), triangles.begin() + 6)),
            (std::vector<std::int32_t>{0, 1, 4, 6, 7, 8}));
  EXPECT_FALSE(file.has("/meshes/000001"));
  EXPECT_TRUE(file.has("/frames/000002"));
  EXPECT_FALSE(file.has("/frames/000003"));
  EXPECT_EQ(file.number_attribute("/frames/000001", "step"), 5);
  EXPECT_EQ(file.number_attribute("/frames/000002", "step"), 7);
  EXPECT_EQ(file.number_attribute("/frames/000002", "time"), 3.5);
  EXPECT_EQ(file.number_attribute("/frames/000002", "multiplier_volume"), 27.5);
  EXPECT_EQ(file.text_attribute("/frames/000002", "mesh"), "/meshes/000000");
  EXPECT_EQ(file.shape("/frames/000001/positions"), (std::vector<hsize_t>{18, 3}));
  EXPECT_EQ(file.numbers("/frames/000001/positions")[4], 1);  // second node is (0, 1, 0)
  EXPECT_EQ(file.numbers("/frames/000001/velocity")[4], 0.5);
  EXPECT_EQ(file.numbers("/frames/000001/order_parameter")[2], -1);
  EXPECT_EQ(file.numbers("/frames/000001/mean_curvature"), std::vector<double>(18, -2));
  EXPECT_EQ(file.numbers("/frames/000001/normal_velocity").size(), 18U);
  EXPECT_EQ(file.numbers("/frames/000001/bending_energy_density").size(), 18U);
  EXPECT_TRUE(file.has("/frames/000001/mesh/triangles"));
  EXPECT_EQ(file.numbers("/series/step"), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(file.numbers("/series/energy_total")[3], 58.75);
  EXPECT_TRUE(std::isnan(file.numbers("/series/multiplier_phase")[3]));
  EXPECT_EQ(file.text_attribute("/configuration", "title"), "a test");
  EXPECT_EQ(file.number_attribute("/configuration/solver", "rtol"), 1e-3);
  EXPECT_EQ(file.text_attribute("/configuration/phase", "kind"), "ramp");
  EXPECT_EQ(file.text_attribute("/configuration/material", "bending_rigidity"), "[1.0, 1.0]");
  EXPECT_EQ(file.text_attribute("/versions", "vesica").substr(0, 2), "0.");
  EXPECT_EQ(file.text_attribute("/outcome", "status"), "converged");
  EXPECT_EQ(file.text_attribute("/outcome", "reason"), "because of the \"test\"");
}

TEST(TrajectoryWriter, AFileOfARunThatGoesOnIsReadableUpToTheLastFrame) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  for (long step = 0; step <= 6; ++step) run.observe(writer, step);
  const ReadableFile file(folder.path() / "trajectory.part.h5");
  EXPECT_EQ(file.numbers("/series/step").size(), 6U);
  EXPECT_TRUE(file.has("/frames/000001"));
  EXPECT_NE(text_of(folder.path() / "trajectory.part.xdmf")
                .find("trajectory.part.h5:/frames/000001/positions"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "trajectory.h5"));
}

TEST(TrajectoryWriter, AnOlderRunStaysWholeUntilTheNewOneIsFinished) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "trajectory.h5") << "old";
  std::ofstream(folder.path() / "trajectory.xdmf") << "old";
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  EXPECT_EQ(text_of(folder.path() / "trajectory.h5"), "old");
  run.finish(writer, relax::RunStatus::numerical_failure);
  EXPECT_EQ(ReadableFile(folder.path() / "trajectory.h5").text_attribute("/outcome", "status"),
            "numerical failure");
  EXPECT_NE(
      text_of(folder.path() / "trajectory.xdmf").find("trajectory.h5:/frames/000000/positions"),
      std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "trajectory.part.h5"));
  EXPECT_FALSE(fs::exists(folder.path() / "trajectory.part.xdmf"));
}

TEST(TrajectoryWriter, AFinalStateThatMovedAfterTheLastStepGetsItsOwnFrameAndRow) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  run.state.values.positions *= 1.5;
  run.finish(writer);
  const ReadableFile file(folder.path() / "trajectory.h5");
  EXPECT_EQ(file.numbers("/frames/000001/positions")[4], 1.5);
  EXPECT_EQ(file.numbers("/series/step").size(), 2U);
}

TEST(TrajectoryWriter, ANewConnectivityGetsItsOwnMesh) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  run.state.triangulation = octahedron().triangulation;
  run.observe(writer, 5);
  run.finish(writer);
  EXPECT_EQ(ReadableFile(folder.path() / "trajectory.h5").text_attribute("/frames/000001", "mesh"),
            "/meshes/000001");
}

TEST(TrajectoryWriter, AChangeOfTheMeshGetsAFrameAndItsReason) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  run.state.triangulation = octahedron().triangulation;
  run.state.values.positions *= 1.5;
  run.report = fake_report(3);
  writer.mesh_changed({run.state, run.report, run.measured},
                      {3, 0.25, 18, 18, 0.25, 0.5, "the test asks"});
  run.finish(writer);
  const ReadableFile file(folder.path() / "trajectory.h5");
  EXPECT_EQ(file.text_attribute("/frames/000001", "mesh"), "/meshes/000001");
  EXPECT_EQ(file.numbers("/frames/000001/positions")[4], 1.5);
  EXPECT_EQ(file.text_attribute("/meshes/000001", "reason"), "the test asks");
  EXPECT_EQ(file.numbers("/series/step").size(), 1U);  // a row is a step
}

TEST(TrajectoryWriter, ParaViewSeesOneFrameAtATime) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  writer.mesh_changed({run.state, run.report, run.measured},
                      {0, run.state.time, 18, 18, 0.25, 0.5, "the test asks"});
  run.finish(writer);
  const auto text = text_of(folder.path() / "trajectory.xdmf");
  EXPECT_EQ(text.find("<Grid Name=\"/frames/000000\""), std::string::npos);
  EXPECT_NE(text.find("<Grid Name=\"/frames/000001\""), std::string::npos);
}

/// It grows frame by frame, the other one is written at once.
TEST(TrajectoryWriter, ParaViewSeesTheSameFramesWhileTheRunGoesOn) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  run.observe(writer, 5);
  writer.mesh_changed({run.state, run.report, run.measured},
                      {5, run.state.time, 18, 18, 0.25, 0.5, "the test asks"});
  run.observe(writer, 10);
  std::string growing = text_of(folder.path() / "trajectory.part.xdmf");
  run.finish(writer);
  for (std::size_t place = 0; (place = growing.find(".part.h5")) != std::string::npos;)
    growing.replace(place, 8, ".h5");
  EXPECT_EQ(growing, text_of(folder.path() / "trajectory.xdmf"));
}

TEST(TrajectoryWriter, EveryFrameHasItsDomainsInOneTable) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.measured.domains = {{1, 3, 6, {1, 2, 3}}, {1, 2, 5, {0, 0, 0}}, {2, 7, 11, {0, 0, -1}}};
  run.observe(writer, 0);
  run.measured.domains = {{2, 12, 0, {0, 0, 0}}};
  run.observe(writer, 5);
  run.finish(writer);
  const ReadableFile file(folder.path() / "trajectory.h5");
  EXPECT_EQ(file.numbers("/domains/frame"), (std::vector<double>{0, 0, 0, 1}));
  EXPECT_EQ(file.numbers("/domains/phase"), (std::vector<double>{1, 1, 2, 2}));
  EXPECT_EQ(file.numbers("/domains/area"), (std::vector<double>{3, 2, 7, 12}));
  EXPECT_EQ(file.numbers("/domains/boundary_length"), (std::vector<double>{6, 5, 11, 0}));
  EXPECT_EQ(file.numbers("/domains/centroid_z"), (std::vector<double>{3, 0, -1, 0}));
}

TEST(TrajectoryWriter, EventsAreKept) {
  const test::TemporaryFolder folder;
  FakeRun run;
  TrajectoryWriter writer(folder.path(), run.config, {});
  run.observe(writer, 0);
  for (const long step : {3, 4}) {
    writer.happened({run.state, run.report, run.measured},
                    {step, 0.25, fmt::format("what happened in step {}", step)});
  }
  run.finish(writer);
  const ReadableFile file(folder.path() / "trajectory.h5");
  EXPECT_EQ(file.number_attribute("/events/000001", "step"), 4);
  EXPECT_EQ(file.number_attribute("/events/000001", "time"), 0.25);
  EXPECT_EQ(file.text_attribute("/events/000000", "what"), "what happened in step 3");
  EXPECT_FALSE(file.has("/events/000002"));
}

TEST(TrajectoryWriter, ASinglePhaseRunCarriesNoOrderParameter) {
  const test::TemporaryFolder folder;
  FakeRun run;
  run.state.values.order_parameter.resize(0);
  run.state.rates.order_parameter.resize(0);
  model::Model model;
  model.is_two_phase = false;
  TrajectoryWriter writer(folder.path(), run.config, {model, {}, {}, {}});
  run.observe(writer, 0);
  run.finish(writer);
  const ReadableFile file(folder.path() / "trajectory.h5");
  EXPECT_FALSE(file.has("/frames/000000/order_parameter"));
  EXPECT_FALSE(file.has("/domains/area"));
  EXPECT_EQ(text_of(folder.path() / "trajectory.xdmf").find("Name=\"c\""), std::string::npos);
}

/// The folder is looked at while it is locked: of two runs that begin at once one is refused.
TEST(TrajectoryWriter, ARunThatHasEndedMeanwhileIsNotReplaced) {
  const test::TemporaryFolder folder;
  FakeRun run;
  {
    TrajectoryWriter first(folder.path(), run.config, {}, false);
    EXPECT_THROW(TrajectoryWriter(folder.path(), run.config, {}, false), ConfigError);
    run.observe(first, 0);
    run.finish(first);
  }
  EXPECT_THROW(TrajectoryWriter(folder.path(), run.config, {}, false), ConfigError);
}

TEST(TrajectoryWriter, AFolderThatDoesNotExistIsNamed) {
  try {
    const TrajectoryWriter writer("/nonexistent/folder", {}, {});
    FAIL();
  } catch (const IoError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("/nonexistent/folder: ")) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos)
        << error.what();
  }
}

TEST(TrajectoryWriter, AFullDiskIsAnErrorThatLeavesTheOlderRunAlone) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "trajectory.h5") << "old";
  FakeRun run;
  run.config.output.every_steps = 1;
  std::string message;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    TrajectoryWriter writer(folder.path(), run.config, {});
    run.observe(writer, 0);
    const rlimit limit{fs::file_size(folder.path() / "trajectory.part.h5") + 100, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    try {
      for (long step = 1; step <= 20; ++step) run.observe(writer, step);
    } catch (const IoError& error) {
      message = error.what();
    }
    EXPECT_NO_THROW(run.finish(writer, relax::RunStatus::numerical_failure));
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find("trajectory.part.h5"), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_EQ(text_of(folder.path() / "trajectory.h5"), "old");
  const ReadableFile file(folder.path() / "trajectory.part.h5");
  EXPECT_EQ(file.numbers("/frames/000000/positions").size(), 54U);
  EXPECT_EQ(file.numbers("/series/step").size(), 1U);
  EXPECT_FALSE(file.has("/frames/000001"));
}

}  // namespace
}  // namespace vesica::io
