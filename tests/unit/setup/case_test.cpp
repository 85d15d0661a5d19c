#include "vesica/setup/case.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace vesica::setup {
namespace {

/// One line each.
std::string warnings_of(const config::RunConfig& config) {
  std::string lines;
  for (const std::string& warning : make_case(config).warnings) lines += warning + "\n";
  return lines;
}

/// Of a two-phase ellipsoid of this length.
std::string warnings_of(config::RunConfig config, double length) {
  config.shape.kind = shapes::ShapeKind::ellipsoid;
  config.shape.semi_axes = {1.4 * length, length, length};
  config.shape.resolution = 4;
  config.phase.emplace().kind = phase::PhaseKind::caps;
  config.material.interface_width = model::Schedule(0.5 * length);
  return warnings_of(config);
}

TEST(CaseWarnings, AreSilentAboutAUsualCase) { EXPECT_EQ(warnings_of({}, 1), ""); }

TEST(CaseWarnings, NameOptionsOfAnotherKind) {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::capsule;
  config.shape.resolution = 4;
  config.shape.length = 3;
  config.shape.radius = 2;
  config.shape.number_of_tips = 4;
  EXPECT_EQ(warnings_of(config),
            "shape.radius means nothing with shape.kind = \"capsule\"\n"
            "shape.number_of_tips means nothing with shape.kind = \"capsule\"\n");
  config = {};
  config.phase.emplace().kind = phase::PhaseKind::caps;
  config.phase->axis = phase::Axis::y;
  config.phase->fraction = 0.4;
  config.phase->seed = 7;
  EXPECT_EQ(warnings_of(config), "phase.seed means nothing with phase.kind = \"caps\"\n");
}

TEST(CaseWarnings, AreSilentAboutTheOptionsOfTheCasesOfThePaper) {
  for (const auto& file : std::filesystem::directory_iterator(VESICA_CASES_DIR)) {
    const config::RunConfig config = config::read_config(file.path().string(), {});
    EXPECT_EQ(warnings_of(config).find("means nothing"), std::string::npos) << file.path();
  }
}

TEST(CaseWarnings, TellWhereTheMeshDoesNotResolveTheInterfaceUnlessItAdapts) {
  config::RunConfig config;
  config.material.interface_width = model::Schedule(0.1);
  config.phase.emplace().kind = phase::PhaseKind::caps;
  EXPECT_NE(warnings_of(config).find("the mesh does not resolve the phase interface"),
            std::string::npos);
  config.adaption.enabled = true;
  EXPECT_EQ(warnings_of(config), "");
}

TEST(CaseOfAMinimiser, TakesTheLastValuesOfSchedulesAndSaysSo) {
  config::RunConfig config;
  config.solver.method = solve::Method::minimize;
  config.phase.emplace();
  config.material.line_tension = model::Schedule::ramp(1, 2, 0, 5);
  config.constraints.targets.of<model::Volume>() = {model::TargetKind::prescribed,
                                                    model::Schedule::ramp(0, 2.6, 0, 0.1), true};
  const Case vesicle = make_case(config);
  EXPECT_EQ(vesicle.model.material.line_tension, model::Schedule(2));
  EXPECT_EQ(*vesicle.model.targets.of<model::Volume>(), model::Schedule(2.6));
  EXPECT_LT(vesicle.model.rests_after(), -1e300);
  const std::string warnings = warnings_of(config);
  EXPECT_NE(
      warnings.find("material.line_tension = [1, 2, 0, 5]: solver.method = \"minimize\" knows "
                    "no time and takes the last value 2\n"),
      std::string::npos)
      << warnings;
  EXPECT_NE(warnings.find("constraints.volume"), std::string::npos);
  config.solver.method = solve::Method::ida;
  EXPECT_EQ(make_case(config).model.material.line_tension, config.material.line_tension);
  EXPECT_EQ(warnings_of(config), "");
}

}  // namespace
}  // namespace vesica::setup
