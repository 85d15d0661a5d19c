#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "vesica/config/config.hpp"
#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

RunConfig read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_config_text(text, "case.toml", overrides);
}

TEST(SemiImplicitOptions, AreReadFromACaseAndFromTheCommandLine) {
  const auto config = read("[solver]\nmethod = \"semi-implicit\"\ntime_step = 2e-4\n",
                           {"solver.tangential_fields=false"});
  EXPECT_EQ(config.solver.method, solve::Method::semi_implicit);
  EXPECT_EQ(config.solver.time_step.value, 2e-4);
  EXPECT_FALSE(config.solver.tangential_fields);
}

TEST(SemiImplicitOptions, TakeTheStepFromTheInterfaceWidthByName) {
  for (const auto& overrides : std::vector<std::vector<std::string>>{
           {}, {"solver.time_step=\"(eps/30)^2\""}, {"solver.time_step=(eps/30)^2"}}) {
    const auto config = read("", overrides);
    EXPECT_FALSE(config.solver.time_step.value);
    EXPECT_DOUBLE_EQ(config.solver.time_step.resolved(0.3), 1e-4);
  }
}

TEST(SemiImplicitOptions, RefuseOtherSteps) {
  for (const std::string value : {"0", "-1e-4", "\"eps\"", "true", "inf"})
    EXPECT_THROW(read("[solver]\ntime_step = " + value), ConfigError) << value;
}

TEST(SemiImplicitOptions, BringThePapersDampingAndStoppingRule) {
  const auto config = read("[solver]\nmethod = \"semi-implicit\"\n");
  EXPECT_EQ(config.damping.kind, relax::DampingKind::paper);
  EXPECT_EQ(config.stop.steps_without_newton, 10);
  const auto chosen = read(
      "[solver]\nmethod = \"semi-implicit\"\n[damping]\nkind = \"speed\"\n[stop]\n"
      "steps_without_newton = 0\n");
  EXPECT_EQ(chosen.damping.kind, relax::DampingKind::speed);
  EXPECT_EQ(chosen.stop.steps_without_newton, 0);
  EXPECT_EQ(read("").damping.kind, relax::DampingKind::speed);
  EXPECT_EQ(read("").stop.steps_without_newton, 0);
}

TEST(SemiImplicitOptions, StandInTheTemplateAndSurviveTheEcho) {
  std::ostringstream text;
  write_template(text);
  EXPECT_NE(text.str().find("#time_step = \"(eps/30)^2\""), std::string::npos);
  EXPECT_NE(text.str().find("#tangential_fields = true"), std::string::npos);
  EXPECT_NE(text.str().find("semi-implicit"), std::string::npos);
  const auto config = read("[solver]\nmethod = \"semi-implicit\"\ntime_step = 0.125\n");
  const auto echo = read(to_toml(config));
  EXPECT_EQ(echo.solver.method, solve::Method::semi_implicit);
  EXPECT_EQ(echo.solver.time_step, config.solver.time_step);
  EXPECT_EQ(to_toml(echo), to_toml(config));
}

}  // namespace
}  // namespace vesica::config
