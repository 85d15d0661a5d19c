#include <filesystem>
#include <string>

#include "flat_json.hpp"
#include "program_test.hpp"
#include "programs.hpp"

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

}  // namespace
}  // namespace vesica
