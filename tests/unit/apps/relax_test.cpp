#include <filesystem>
#include <string>
#include <utility>

#include "flat_json.hpp"
#include "program_test.hpp"
#include "programs.hpp"
#include "vesica/io/run_reader.hpp"

namespace vesica {
namespace {

namespace fs = std::filesystem;

/// Deflated from 4.75 to 4.6 until t = 0.05.
const std::string deflated_case =
    std::string(test::prolate_case) + "[constraints]\nvolume = [\"initial\", 4.6, 0, 0.05]\n";

class RelaxTest : public test::ProgramTest {
 protected:
  RelaxTest() { write("case.toml", deflated_case); }
  int relax(const std::string& arguments) { return run(program_relax, arguments); }
  [[nodiscard]] double verdict(const std::string& run, const std::string& key) const {
    return test::flat_json(folder_ / run / "verdict.json").at(key);
  }
};

TEST_F(RelaxTest, GoesOnWithARunThatStoppedInTheMiddleOfARamp) {
  ASSERT_EQ(relax("case.toml --set stop.end_time=0.02 --out first"), 1) << output_;
  EXPECT_GT(verdict("first", "/shape/volume"), 4.65);
  ASSERT_EQ(relax("case.toml --resume first --out second"), 0) << output_;
  EXPECT_NEAR(verdict("second", "/shape/volume"), 4.6, 1e-7);
  ASSERT_EQ(relax("case.toml --out whole"), 0) << output_;
  EXPECT_NEAR(verdict("second", "/energy/total"), verdict("whole", "/energy/total"), 1e-2);
}

/// "initial" is the start of the first run also in the third of a chain.
TEST_F(RelaxTest, AChainOfRunsFollowsTheRampOfOneRun) {
  ASSERT_EQ(relax("case.toml --set stop.end_time=0.01 --out first"), 1) << output_;
  ASSERT_EQ(relax("case.toml --set stop.end_time=0.02 --resume first --out second"), 1) << output_;
  ASSERT_EQ(relax("case.toml --set stop.end_time=0.03 --resume second --out third"), 1) << output_;
  ASSERT_EQ(relax("case.toml --set stop.end_time=0.03 --out whole"), 1) << output_;
  for (const std::string name : {"volume", "area"}) {
    const auto target = [&](const std::string& run) {
      return verdict(run, "/shape/" + name) / (1 + verdict(run, "/constraints/" + name));
    };
    EXPECT_NEAR(target("third"), target("whole"), 1e-12) << name;
  }
}

TEST_F(RelaxTest, GoesOnWithARunThatBrokeOff) {
  const std::string slow =
      "case.toml --set output.every_steps=1 --set stop.normal_velocity=1e-300 "
      "--set stop.max_steps=100000 --set solver.max_step=1e-4 --out broken";
  ASSERT_EQ(relax("--help > /dev/null; timeout --foreground --signal=KILL 4 '" +
                  std::string(program_relax) + "' " + slow),
            137)
      << output_;
  ASSERT_TRUE(fs::exists(folder_ / "broken" / "trajectory.part.h5"));
  ASSERT_EQ(relax("case.toml --resume broken --out second"), 0) << output_;
  EXPECT_NEAR(verdict("second", "/shape/volume"), 4.6, 1e-7);
}

TEST_F(RelaxTest, GoesOnInItsFolderUntilItHasConvergedAndThenSaysSo) {
  ASSERT_EQ(relax("case.toml --set stop.max_steps=10 --set output.every_steps=1 --out run"), 1);
  int status = 1;
  for (int i = 0; i < 20 && status == 1; ++i) status = relax("--resume run --out run --overwrite");
  ASSERT_EQ(status, 0) << output_;
  const compare::EnergyHistory history = io::read_history(folder_ / "run");
  for (std::size_t i = 1; i + 1 < history.step.size(); ++i)
    EXPECT_EQ(history.step[i], history.step[i - 1] + 1);
  EXPECT_EQ(history.step.back(), verdict("run", "/counts/steps"));
  const auto written = fs::last_write_time(folder_ / "run" / "trajectory.h5");
  ASSERT_EQ(relax("--resume run"), 0);
  EXPECT_NE(output_.find("run: the run has converged at t = "), std::string::npos) << output_;
  EXPECT_EQ(fs::last_write_time(folder_ / "run" / "trajectory.h5"), written);
  ASSERT_EQ(relax("case.toml --out whole"), 0) << output_;
  EXPECT_NEAR(verdict("run", "/energy/total"), verdict("whole", "/energy/total"), 1e-2);
}

TEST_F(RelaxTest, NamesWhatHasChangedAndRefusesWhatAResumedRunCannotTake) {
  ASSERT_EQ(relax("case.toml --set stop.max_steps=4 --out run"), 1) << output_;
  EXPECT_EQ(relax("--resume run --set shape.resolution=3"), 2);
  EXPECT_NE(output_.find("--set shape.resolution=3: shape.resolution = 3: a resumed run goes on "
                         "from its last state, which began with 2"),
            std::string::npos)
      << output_;
  EXPECT_EQ(relax("--resume run --set stop.max_steps=1 --set "
                  "constraints.volume='[4.74,4.73,0,1e-9]'"),
            1);
  EXPECT_NE(output_.find("the run goes on with stop.max_steps = 1 instead of 4"), std::string::npos)
      << output_;
  EXPECT_NE(output_.find("begins before t = "), std::string::npos) << output_;
}

TEST_F(RelaxTest, TellsWhereAValueWasWrittenThatDoesNotFitTheOthers) {
  write("torus.toml", "[shape]\nkind = \"torus\"\nminor_radius = 1.5\n");
  EXPECT_EQ(relax("torus.toml --out torus"), 2);
  EXPECT_NE(output_.find("torus.toml:3:16: shape.minor_radius = 1.5: must be"), std::string::npos)
      << output_;
  EXPECT_EQ(relax("torus.toml --set shape.minor_radius=2 --out torus"), 2);
  EXPECT_NE(output_.find("--set shape.minor_radius=2: shape.minor_radius = 2: must be"),
            std::string::npos)
      << output_;
  EXPECT_FALSE(fs::exists(folder_ / "torus"));
}

TEST_F(RelaxTest, EvenAQuietRunSaysThatItFailed) {
  write("slender.toml", "[shape]\nkind = \"ellipsoid\"\nsemi_axes = [1.84, 0.66, 0.66]\n");
  EXPECT_EQ(relax("slender.toml --set shape.resolution=4 --set solver.method=semi-implicit "
                  "--set solver.time_step=10 --set damping.initial=1 --set stop.max_steps=20 "
                  "--quiet --out run"),
            3);
  EXPECT_EQ(output_.find("vesica-relax: numerical failure: "), 0U) << output_;
}

TEST_F(RelaxTest, ACaseFileThatCannotBeReadIsAnErrorOfFiles) {
  EXPECT_EQ(relax("none.toml --out run"), 4);
  EXPECT_NE(output_.find("none.toml: cannot be read"), std::string::npos) << output_;
}

const std::string octahedron =
    "OFF\n6 8\n1 0 0\n-1 0 0\n0 1.2 0\n0 -1.2 0\n0 0 1\n0 0 -1\n"
    "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

/// The case.toml of the run stands in another folder than the surface, and can be run again there.
TEST_F(RelaxTest, FindsASurfaceBesideTheCaseFileFromAnotherFolder) {
  fs::create_directory(folder_ / "sub");
  write("sub/surface.off", octahedron);
  write("sub/file.toml",
        "[shape]\nkind = \"file\"\npath = \"surface.off\"\n[stop]\nmax_steps = 1\n");
  EXPECT_NE(relax("sub/file.toml --out sub/run"), 4) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "sub/run/case.toml")) << output_;
  EXPECT_NE(relax("sub/run/case.toml --out again"), 4) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "again/case.toml")) << output_;
  EXPECT_EQ(relax("sub/file.toml --set shape.path=surface.off --out third"), 4);
  EXPECT_NE(output_.find("shape.path = \"surface.off\": there is no file"), std::string::npos)
      << output_;
}

TEST_F(RelaxTest, RefusesToGoOnWithARunOfAnotherKind) {
  ASSERT_EQ(relax("case.toml --set stop.max_steps=1 --out first"), 1) << output_;
  EXPECT_EQ(relax("case.toml --set phase.kind=ramp --set phase.match_target=false --resume first "
                  "--out second"),
            2);
  EXPECT_NE(output_.find("the run has no phase field, the case has one"), std::string::npos)
      << output_;
  EXPECT_EQ(relax("case.toml --resume nowhere --out second"), 4) << output_;
  EXPECT_FALSE(fs::exists(folder_ / "second"));
}

TEST_F(RelaxTest, RefusesASurfaceThatTheMeshMethodOrTheModelCannotTake) {
  EXPECT_EQ(relax("case.toml --set shape.kind=torus --set shape.resolution=4 --set "
                  "adaption.enabled=true --set adaption.method=conformal --out torus"),
            2);
  EXPECT_NE(output_.find("adaption.method = \"conformal\": the surface has genus 1"),
            std::string::npos)
      << output_;
  EXPECT_FALSE(fs::exists(folder_ / "torus"));
  // two tetrahedra
  write("two.off",
        "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 0 0\n6 0 0\n5 1 0\n5 0 1\n"
        "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n");
  EXPECT_EQ(relax("case.toml --set shape.kind=file --set shape.path=two.off --out two"), 2);
  EXPECT_NE(output_.find("the surface has 2 pieces: must be one vesicle"), std::string::npos)
      << output_;
}

/// The files of a run must not take the places of its output.
TEST_F(RelaxTest, RunsWithoutStandardInputAndOutput) {
  EXPECT_EQ(run("/bin/sh",
                "-c \"'" + std::string(program_relax) + "' case.toml --out run <&- >&- 2>&-\""),
            0);
  EXPECT_NO_THROW((void)io::read_run(folder_ / "run"));
}

TEST_F(RelaxTest, EverySignalThatAsksForTheEndSavesTheRun) {
  const std::string slow =
      "case.toml --overwrite --set stop.normal_velocity=1e-300 --set solver.max_step=1e-5 --out "
      "run";
  for (const auto& [signal, status] : {std::pair{"HUP", 129}, std::pair{"XCPU", 152}}) {
    EXPECT_EQ(relax("--help > /dev/null; timeout --foreground --preserve-status --signal=" +
                    std::string(signal) + " 2 '" + program_relax + "' " + slow),
              status)
        << output_;
    EXPECT_NE(output_.find("SIG" + std::string(signal) + " received"), std::string::npos);
    EXPECT_NO_THROW((void)io::read_run(folder_ / "run"));
  }
}

class SlowRelaxTest : public RelaxTest {};

/// The rates are round-off there: on a mesh this fine above the tolerance of the initial values.
TEST_F(SlowRelaxTest, GoesOnFromAStateAtRest) {
  write("rest.toml",
        "[shape]\nkind = 'ellipsoid'\nresolution = 5\nsemi_axes = [1.4, 1.0, 1.0]\n"
        "[phase]\nkind = 'caps'\naxis = 'x'\nends = 'high'\nfraction = 0.4\n"
        "[material]\nline_tension = 2.0\ninterface_width = 0.3\n"
        "[constraints]\nreduced_volume = 0.95\n[adaption]\nenabled = true\n");
  ASSERT_EQ(relax("rest.toml --out first"), 0) << output_;
  ASSERT_EQ(relax("--resume first --out same"), 0) << output_;
  EXPECT_NEAR(verdict("same", "/energy/total"), verdict("first", "/energy/total"), 1e-4);
  ASSERT_EQ(relax("--resume first --set material.line_tension=2.001 --out raised"), 0) << output_;
  EXPECT_GT(verdict("raised", "/energy/line"), verdict("first", "/energy/line"));
}

}  // namespace
}  // namespace vesica
