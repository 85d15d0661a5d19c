#include <filesystem>
#include <string>

#include "flat_json.hpp"
#include "program_test.hpp"
#include "programs.hpp"

namespace vesica {
namespace {

namespace fs = std::filesystem;

class CompareTest : public test::ProgramTest {
 protected:
  CompareTest() { write("prolate.toml", test::prolate_case); }
  int compare(const std::string& arguments) { return run(program_compare, arguments); }
};

/// Two flows with different tolerances in place of flow and minimiser.
const std::string two_flows =
    "prolate.toml --set-minimize solver.method=ida --set-minimize solver.rtol=1e-3 ";

TEST_F(CompareTest, ReportsTwoRunsOfACaseThatAgreeWithTheirVerdicts) {
  ASSERT_EQ(compare(two_flows + "--out both"), 0) << output_;
  EXPECT_NE(output_.find("flow and minimize found the same equilibrium"), std::string::npos)
      << output_;
  const auto comparison = test::flat_json(folder_ / "both" / "comparison.json");
  for (const std::string name : {"flow", "minimize"}) {
    const auto verdict = test::flat_json(folder_ / "both" / name / "verdict.json");
    EXPECT_GT(verdict.size(), 40U);
    for (const auto& [pointer, value] : verdict.items())
      EXPECT_EQ(comparison.at("/" + name + pointer), value) << pointer;
    EXPECT_TRUE(fs::exists(folder_ / "both" / ("profile_" + name + ".csv")));
    EXPECT_TRUE(fs::exists(folder_ / "both" / name / "trajectory.h5"));
  }
  if (output_.find("no pictures: gnuplot is not installed") == std::string::npos) {
    EXPECT_GT(fs::file_size(folder_ / "both" / "profiles.png"), 5000U);
    EXPECT_GT(fs::file_size(folder_ / "both" / "energy.png"), 5000U);
  }
  const double flow = comparison.at("/flow/energy/total");
  const double minimum = comparison.at("/minimize/energy/total");
  EXPECT_DOUBLE_EQ(comparison.at("/difference/energy/absolute"), minimum - flow);
  EXPECT_EQ(comparison.at("/difference/same_equilibrium"), true);
  EXPECT_LT(comparison.at("/difference/shape_l2"), 1e-2);
  EXPECT_GT(comparison.at("/difference/shape_l2"), 0);

  const double shape_l2 = comparison.at("/difference/shape_l2");
  ASSERT_EQ(compare("both/flow both/minimize --quiet --out again"), 0) << output_;
  const auto again = test::flat_json(folder_ / "again" / "comparison.json");
  EXPECT_NEAR(again.at("/difference/shape_l2").get<double>(), shape_l2, 1e-12);
  EXPECT_EQ(again.at("/first/energy/total"), flow);
  EXPECT_EQ(again.at("/second/counts/steps"), comparison.at("/minimize/counts/steps"));

  EXPECT_EQ(compare(two_flows + "--out both"), 2) << "an older comparison is not replaced";
  EXPECT_NE(output_.find("already holds a run"), std::string::npos) << output_;
}

TEST_F(CompareTest, EndsWithTheWorstStatusOfItsRuns) {
  EXPECT_EQ(compare(two_flows + "--out few --set-minimize stop.max_steps=2"), 1) << output_;
  EXPECT_NE(output_.find("minimize has not converged (step limit)"), std::string::npos) << output_;
  EXPECT_TRUE(test::flat_json(folder_ / "few" / "comparison.json")
                  .at("/difference/same_equilibrium")
                  .is_null());
}

TEST_F(CompareTest, BadInputEndsWithStatusTwoBeforeAnythingIsWritten) {
  for (const std::string arguments :
       {"", "a b c", "prolate.toml --scheme one", "prolate.toml --set x",
        "prolate.toml --set-minimize solver.method=none"}) {
    EXPECT_EQ(compare(arguments + " --out out"), 2) << arguments << "\n" << output_;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << arguments;
  }
}

TEST_F(CompareTest, AMissingFolderOrFileEndsWithStatusFour) {
  EXPECT_EQ(compare("nowhere neither"), 4);
  EXPECT_EQ(output_, "vesica-compare: nowhere: no such folder\n");
  EXPECT_EQ(compare("missing.toml --out out"), 4);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CompareTest, ASignalSavesTheRunAndEndsTheProgram) {
  const std::string slow = two_flows +
                           "--out stopped --set shape.resolution=6 "
                           "--set-flow stop.normal_velocity=1e-300";
  const int status =
      compare("--help > /dev/null; timeout --foreground --signal=TERM --preserve-status 5 '" +
              std::string(program_compare) + "' " + slow);
  EXPECT_EQ(status, 143) << output_;
  EXPECT_EQ(test::flat_json(folder_ / "stopped" / "flow" / "verdict.json").at("/status"),
            "interrupted");
  EXPECT_FALSE(fs::exists(folder_ / "stopped" / "minimize"));
  EXPECT_NE(output_.find("interrupted in the run flow, which is saved"), std::string::npos);
}

}  // namespace
}  // namespace vesica
