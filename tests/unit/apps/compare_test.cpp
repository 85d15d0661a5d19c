#include <filesystem>
#include <string>

#include "io/json_reader.hpp"
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
  const io::JsonReader comparison(folder_ / "both" / "comparison.json");
  for (const std::string name : {"flow", "minimize"}) {
    const io::JsonReader verdict(folder_ / "both" / name / "verdict.json");
    for (const std::string& pointer : verdict.number_pointers()) {
      EXPECT_EQ(comparison.optional_number("/" + name + pointer), verdict.optional_number(pointer))
          << pointer;
    }
    EXPECT_TRUE(fs::exists(folder_ / "both" / ("profile_" + name + ".csv")));
    EXPECT_TRUE(fs::exists(folder_ / "both" / name / "trajectory.h5"));
  }
  if (output_.find("no pictures: gnuplot is not installed") == std::string::npos) {
    EXPECT_GT(fs::file_size(folder_ / "both" / "profiles.png"), 5000U);
    EXPECT_GT(fs::file_size(folder_ / "both" / "energy.png"), 5000U);
  }
  const double flow = comparison.number("/flow/energy/total");
  const double minimum = comparison.number("/minimize/energy/total");
  EXPECT_DOUBLE_EQ(comparison.number("/difference/energy/absolute"), minimum - flow);
  EXPECT_EQ(comparison.optional_flag("/difference/same_equilibrium"), true);
  EXPECT_LT(comparison.number("/difference/shape_l2"), 1e-2);
  EXPECT_GT(comparison.number("/difference/shape_l2"), 0);

  const double shape_l2 = comparison.number("/difference/shape_l2");
  ASSERT_EQ(compare("both/flow both/minimize --quiet --out again"), 0) << output_;
  const io::JsonReader again(folder_ / "again" / "comparison.json");
  EXPECT_NEAR(again.number("/difference/shape_l2"), shape_l2, 1e-12);
  EXPECT_EQ(again.number("/first/energy/total"), flow);
  EXPECT_EQ(again.number("/second/counts/steps"), comparison.number("/minimize/counts/steps"));

  EXPECT_EQ(compare(two_flows + "--out both"), 2) << "an older comparison is not replaced";
  EXPECT_NE(output_.find("already holds a run"), std::string::npos) << output_;
}

TEST_F(CompareTest, EndsWithTheWorstStatusOfItsRuns) {
  EXPECT_EQ(compare(two_flows + "--out few --set-minimize stop.max_steps=2"), 1) << output_;
  EXPECT_NE(output_.find("minimize has not converged (step limit)"), std::string::npos) << output_;
  EXPECT_FALSE(io::JsonReader(folder_ / "few" / "comparison.json")
                   .optional_flag("/difference/same_equilibrium"));
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
  EXPECT_EQ(io::JsonReader(folder_ / "stopped" / "flow" / "verdict.json").text("/status"),
            "interrupted");
  EXPECT_FALSE(fs::exists(folder_ / "stopped" / "minimize"));
  EXPECT_NE(output_.find("interrupted in the run flow, which is saved"), std::string::npos);
}

}  // namespace
}  // namespace vesica
