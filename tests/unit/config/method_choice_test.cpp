#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "vesica/config/config.hpp"
#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

struct Expectation {
  std::string text;
  solve::Method method;
  std::string reason;
};

void PrintTo(const Expectation& expectation, std::ostream* out) { *out << expectation.text; }

class MethodChoiceTest : public ::testing::TestWithParam<Expectation> {};

TEST_P(MethodChoiceTest, FollowsWhatTheCaseAsksFor) {
  const auto& [text, method, reason] = GetParam();
  const RunConfig config = read_config_text(text, "case.toml", {});
  const MethodChoice choice = choose_method(config);
  EXPECT_EQ(choice.method, method);
  EXPECT_NE(choice.reason.find(reason), std::string::npos) << choice.reason;
  EXPECT_EQ(resolved(config).solver.method, method);
  EXPECT_EQ(resolved(resolved(config)).solver.method, method);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, MethodChoiceTest,
    ::testing::Values(
        Expectation{"", solve::Method::minimize, "an equilibrium is wanted"},
        Expectation{"[solver]\nmethod = \"auto\"", solve::Method::minimize, "equilibrium"},
        Expectation{"[solver]\nmethod = \"ida\"", solve::Method::ida, "the case names it"},
        Expectation{"[solver]\nmethod = \"semi-implicit\"", solve::Method::semi_implicit, "names"},
        Expectation{"[stop]\nend_time = 0.5", solve::Method::ida, "stop.end_time is a time"},
        Expectation{"[material]\nline_tension = [1, 2, 0, 5]", solve::Method::ida,
                    "material.line_tension changes in time"},
        Expectation{"[material]\nspontaneous_curvature = [[0, -1, 0, 5], 0]", solve::Method::ida,
                    "material.spontaneous_curvature changes in time"},
        Expectation{"[constraints]\nvolume = [\"initial\", 2.5, 0, 1]", solve::Method::ida,
                    "constraints.volume changes in time"},
        Expectation{"[solver]\nscheme = \"variational\"", solve::Method::ida,
                    "solver.scheme is an option of the flow"},
        Expectation{"[stop]\nnormal_velocity = 1e-5", solve::Method::ida,
                    "stop.normal_velocity is an option of the flow"},
        Expectation{"[damping]\nkind = \"fixed\"", solve::Method::ida,
                    "damping.kind is an option of the flow"},
        Expectation{"[solver]\naccuracy = \"draft\"", solve::Method::minimize, "equilibrium"},
        Expectation{"[solver]\naccuracy = \"draft\"\nrtol = 1e-3", solve::Method::ida,
                    "solver.rtol is an option of the flow"},
        Expectation{"[adaption]\nenabled = true", solve::Method::minimize, "equilibrium"},
        Expectation{"[adaption]\nenabled = true\nmethod = \"bisection\"", solve::Method::ida,
                    "adaption.method = bisection needs it"}));

TEST(MethodChoice, IsTheDefaultOfCasesAndOfConfigurations) {
  EXPECT_EQ(RunConfig{}.solver.method, solve::Method::automatic);
  EXPECT_EQ(read_config_text("", "case.toml", {}).solver.method, solve::Method::automatic);
  EXPECT_EQ(solve::SolverOptions{}.method, solve::Method::ida);
}

}  // namespace
}  // namespace vesica::config
