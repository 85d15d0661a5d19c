#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "initial_phase_fixture.hpp"
#include "surface_samples.hpp"

namespace vesica::phase {
namespace {

TEST(InitialPhase, RefusesOptionsThatDescribeNoPhaseField) {
  const auto surface = problem::unit_sphere(1);
  auto options = of_kind(PhaseKind::spots);
  options.directions.clear();
  EXPECT_EQ(refusal(options, surface), "phase.directions = []: must name at least one direction");
  options.directions = {{1, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(refusal(options, surface),
            "phase.directions[1] = [0, 0, 0]: must be finite and not zero");
  options = of_kind(PhaseKind::spots);
  options.angle = 180;
  EXPECT_EQ(refusal(options, surface), "phase.angle = 180: must be < 180");
  options = of_kind(PhaseKind::ramp);
  options.to = options.from;
  EXPECT_EQ(refusal(options, surface), "phase.to = 0.25: must differ from phase.from = 0.25");
  options = of_kind(PhaseKind::uniform);
  options.mean = 1.5;
  EXPECT_EQ(refusal(options, surface), "phase.mean = 1.5: must be between -1 and 1");
  options = of_kind(PhaseKind::caps);
  options.fraction = 1.5;
  EXPECT_EQ(refusal(options, surface), "phase.fraction = 1.5: must be between 0 and 1");
  options = of_kind(PhaseKind::bands);
  options.count = 0;
  EXPECT_EQ(refusal(options, surface), "phase.count = 0: must be >= 1");
  options = of_kind(PhaseKind::bands);
  options.direction = BandDirection::around;
  options.axis = Axis::radial;
  EXPECT_EQ(refusal(options, surface),
            "phase.axis = \"radial\": bands around an axis need x, y or z");
  EXPECT_EQ(refusal({}, surface, std::nullopt, 0.0), "material.interface_width = 0: must be > 0");
}

TEST(InitialPhase, RefusesFilesThatDoNotFitNamingTheLine) {
  const auto surface = problem::unit_sphere(1);
  ASSERT_EQ(surface.positions.rows(), 42);
  auto options = of_kind(PhaseKind::file);
  const auto message = [&](const std::string& text) {
    const PhaseFile file(text);
    options.path = file.path();
    const auto whole = refusal(options, surface);
    return whole.substr(std::min(whole.size(), file.path().size()));
  };
  EXPECT_EQ(message("0.5\n\n# comment\nabc\n"), ":4: 'abc': must be one finite number");
  EXPECT_EQ(message("0.5 0.5\n"), ":1: '0.5 0.5': must be one finite number");
  EXPECT_EQ(message("nan\n"), ":1: 'nan': must be one finite number");
  EXPECT_EQ(message("0.5\n0.25\n"),
            ":2: ends after 2 values: must be one for each of the 12 vertices or of the 42 nodes "
            "(vertices and edges)");
  std::string long_text;
  for (int i = 0; i < 43; ++i) long_text += "0\n";
  EXPECT_EQ(message(long_text),
            ":43: value number 43: must be one for each of the 12 vertices or of the 42 nodes "
            "(vertices and edges)");
}

TEST(InitialPhase, RefusesValuesOfAFileThatAreNeitherPhasesNorLabels) {
  const auto surface = problem::unit_sphere(1);
  auto options = of_kind(PhaseKind::file);
  const auto message = [&](const std::string& first, const std::string& others) {
    std::string text = first + "\n";
    for (int i = 1; i < 12; ++i) text += others + "\n";
    const PhaseFile file(text);
    options.path = file.path();
    const auto whole = refusal(options, surface);
    return whole.substr(std::min(whole.size(), file.path().size()));
  };
  const std::string rule =
      "must be in [-1, 1] (up to 1.05 counts as overshoot), or all values the labels 0 and 1, or 1 "
      "and 2";
  EXPECT_EQ(message("1", "-1.5"), ":2: -1.5: " + rule);
  EXPECT_EQ(message("0", "2"), ":2: 2: " + rule);
  EXPECT_EQ(message("2", "2"), ":1: 2: " + rule);
  EXPECT_EQ(message("3", "1"), ":1: 3: " + rule);
  EXPECT_EQ(message("1.5", "1"), ":1: 1.5: " + rule);
  EXPECT_EQ(message("1.05", "-1.05"), "") << "accepted";
}

TEST(InitialPhase, RefusesAPointFieldThatIsNotThereOrDoesNotFit) {
  const auto surface = problem::unit_sphere(1);
  auto options = of_kind(PhaseKind::file);
  options.field = std::string("c");
  EXPECT_EQ(refusal(options, surface),
            "phase.field = \"c\": the file of the shape has no point fields");
  const auto message = [&](const std::string& name, const Eigen::VectorXd& values) {
    const std::vector<mesh::PointField> fields{{name, "s.ply: point field '" + name + "'", values}};
    try {
      (void)start_phase(options, surface, width, std::nullopt, fields);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message("d", Eigen::VectorXd::Zero(12)),
            "phase.field = \"c\": must be a point field of the shape's file: d");
  EXPECT_EQ(message("c", Eigen::VectorXd::Zero(11)),
            "s.ply: point field 'c': ends after 11 values: must be one for each of the 12 vertices "
            "or of the 42 nodes (vertices and edges)");
  EXPECT_EQ(message("c", Eigen::VectorXd::Constant(12, std::nan(""))),
            "s.ply: point field 'c': value number 1: nan: must be a finite number");
  EXPECT_EQ(message("c", Eigen::VectorXd::Constant(12, 3)).substr(0, 46),
            "s.ply: point field 'c': value number 1: 3: mus");
  options.path = std::string("phase.txt");
  EXPECT_EQ(refusal(options, surface), "phase.field = \"c\": leaves no use for phase.path");
}

TEST(InitialPhase, RefusesFilesThatCannotBeRead) {
  const auto surface = problem::unit_sphere(1);
  auto options = of_kind(PhaseKind::file);
  options.path = testing::TempDir() + "no-such-file.txt";
  EXPECT_EQ(refusal<IoError>(options, surface), options.path + ": cannot be opened for reading");
  options.path = testing::TempDir();
  EXPECT_EQ(refusal<IoError>(options, surface), options.path + ": cannot be read: it is a folder");
  options.path = "";
  EXPECT_EQ(refusal(options, surface), "phase.path = \"\": must name a file");
}

}  // namespace
}  // namespace vesica::phase
