#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
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

/// The message with which a text is refused; empty when it is not.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read(text, overrides);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Config, AnEmptyCaseHasTheDefaultsAndOnePhase) {
  const RunConfig config = read("");
  EXPECT_FALSE(config.phase);
  EXPECT_EQ(config.output.every_steps, 5);
  EXPECT_EQ(to_toml(config), to_toml(RunConfig{}));
}

TEST(Config, ReadsEveryKindOfValue) {
  const RunConfig config = read(R"(
title = "a \"test\""
[shape]
kind = "ellipsoid"
semi_axes = [2, 1.5, 1]
resolution = 4
[phase]
kind = "spots"
directions = [[1, 0, 0], [0, 1.0, 0]]
match_target = false
[material]
bending_rigidity = 2
gaussian_rigidity = [0.5, -0.5]
rigidity_ratio = 3
[constraints]
volume = [3, 2.5, 0.0, 1]
area = "free"
phase_difference = 4
[stop]
end_time = inf
[damping]
maximum = 5
)");
  EXPECT_EQ(config.title, "a \"test\"");
  EXPECT_EQ(config.shape.kind, shapes::ShapeKind::ellipsoid);
  EXPECT_EQ(config.shape.semi_axes, Eigen::Vector3d(2, 1.5, 1));
  ASSERT_TRUE(config.phase);
  EXPECT_EQ(config.phase->directions, (std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(config.phase->match_target);
  EXPECT_EQ(config.material.bending_rigidity, (model::PhaseSchedules{2, 2}));
  EXPECT_EQ(config.material.gaussian_rigidity, (model::PhaseSchedules{0.5, -0.5}));
  EXPECT_EQ(config.material.rigidity_ratio, 3.0);
  EXPECT_EQ(config.constraints.targets.of<model::Volume>(),
            (model::Target{model::TargetKind::prescribed, model::Schedule::ramp(3, 2.5, 0, 1)}));
  EXPECT_EQ(config.constraints.targets.of<model::Area>().kind, model::TargetKind::free);
  EXPECT_EQ(config.constraints.targets.of<model::PhaseDifference>(),
            (model::Target{model::TargetKind::prescribed, model::Schedule(4)}));
  EXPECT_TRUE(std::isinf(config.stop.end_time));
  EXPECT_EQ(config.damping.maximum, 5.0);
}

struct BadInput {
  const char* text;
  const char* message;
};

class RefusedInput : public testing::TestWithParam<BadInput> {};

TEST_P(RefusedInput, IsNamedWithItsPlaceAndRule) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Config, RefusedInput,
    testing::Values(
        BadInput{"\n[solver]\n  rtoll = 0.1",
                 "case.toml:3:3: solver.rtoll = 0.1: unknown key, did you mean \"rtol\"?"},
        BadInput{"[sovler]\nrtol = 1.0",
                 "case.toml:1:2: [sovler]: unknown table, did you mean \"solver\"?"},
        BadInput{"tittle = 'x'",
                 "case.toml:1:1: tittle = 'x': unknown key, did you mean \"title\"?"},
        BadInput{"[output]\nevery_steps = 2.5",
                 "case.toml:2:15: output.every_steps = 2.5: must be an integer"},
        BadInput{"[output]\nevery_steps = 0",
                 "case.toml:2:15: output.every_steps = 0: must be >= 1"},
        BadInput{"[output]\nevery_steps = 3000000000",
                 "case.toml:2:15: output.every_steps = 3000000000: must fit into 32 bits"},
        BadInput{"[output]\nparaview = 1",
                 "case.toml:2:12: output.paraview = 1: must be true or false"},
        BadInput{"[output]\ndirectory = 1",
                 "case.toml:2:13: output.directory = 1: must be a string"},
        BadInput{"[output]\ndirectory = ''",
                 "case.toml:2:13: output.directory = '': must not be empty"},
        BadInput{"[material]\ninterface_width = -0.1",
                 "case.toml:2:19: material.interface_width = -0.1: must be > 0"},
        BadInput{"[material]\ninterface_width = 0",
                 "case.toml:2:19: material.interface_width = 0: must be > 0"},
        BadInput{"[material]\ninterface_width = inf",
                 "case.toml:2:19: material.interface_width = inf: must be finite"},
        BadInput{"[material]\nline_tension = nan",
                 "case.toml:2:16: material.line_tension = nan: must be >= 0"},
        BadInput{"[material]\nline_tension = 'high'",
                 "case.toml:2:16: material.line_tension = 'high': must be a number, [from, to, t0, "
                 "t1] or "
                 "{ times = [...], values = [...], kind = ... }"},
        BadInput{"[material]\nbending_rigidity = [1, 0]",
                 "case.toml:2:20: material.bending_rigidity = [ 1, 0 ]: must be > 0"},
        BadInput{
            "[constraints]\nreduced_volume = ['initial', 0.85, 0, 1]",
            "case.toml:2:18: constraints.reduced_volume = [ 'initial', 0.85, 0, 1 ]: must be a "
            "number"},
        BadInput{"[material]\nbending_rigidity = [1, 2, 3]",
                 "case.toml:2:20: material.bending_rigidity = [ 1, 2, 3 ]: must be a number, "
                 "[from, to, t0, t1], { times = [...], values = [...], kind = ... } or an array "
                 "[phase 1, phase 2] of these"},
        BadInput{
            "[material]\nbending_rigidity = [1, [1, 2, 3]]",
            "case.toml:2:20: material.bending_rigidity = [ 1, [ 1, 2, 3 ] ]: must be a number, "
            "[from, to, t0, t1], { times = [...], values = [...], kind = ... } or an array "
            "[phase 1, phase 2] of these"},
        BadInput{"[material]\nbending_rigidity = [1, [1, 0, 0, 1]]",
                 "case.toml:2:20: material.bending_rigidity = [ 1, [ 1, 0, 0, 1 ] ]: must be > 0"},
        BadInput{
            "[material]\nline_tension = ['initial', 2, 0, 1]",
            "case.toml:2:16: material.line_tension = [ 'initial', 2, 0, 1 ]: must be a number, "
            "[from, to, t0, t1] or { times = [...], values = [...], kind = ... }"},
        BadInput{"[material]\nline_tension = { times = [0, 1], values = [1, 2, 3] }",
                 "case.toml:2:16: material.line_tension = { times = [ 0, 1 ], values = [ 1, 2, 3 ] "
                 "}: must have as many times as values"},
        BadInput{
            "[material]\nline_tension = { times = [0, 2, 1], values = [1, 2, 3] }",
            "case.toml:2:16: material.line_tension = { times = [ 0, 2, 1 ], values = [ 1, 2, 3 "
            "] }: must have ascending times"},
        BadInput{"[material]\nline_tension = { times = [0, inf], values = [1, 2] }",
                 "case.toml:2:16: material.line_tension = { times = [ 0, inf ], values = [ 1, 2 ] "
                 "}: must be finite"},
        BadInput{"[material]\nline_tension = { time = [0, 1], values = [1, 2] }",
                 "case.toml:2:16: material.line_tension = { time = [ 0, 1 ], values = [ 1, 2 ] }: "
                 "unknown key \"time\", did you mean \"times\"?"},
        BadInput{"[material]\nline_tension = { times = [0, 1], values = [1, 2], kind = 'steps' }",
                 "case.toml:2:16: material.line_tension.kind = 'steps': must be one of \"linear\", "
                 "\"stages\""},
        BadInput{"[constraints]\nvolume = [2, 'initial', 0, 1]",
                 "case.toml:2:10: constraints.volume = [ 2, 'initial', 0, 1 ]: must be a number, "
                 "[from, to, t0, t1], { times = [...], values = [...], kind = ... }, \"initial\" "
                 "(also as the first value) or \"free\""},
        BadInput{"[constraints]\nvolume = 'fixed'",
                 "case.toml:2:10: constraints.volume = 'fixed': must be a number, [from, to, t0, "
                 "t1], { times = [...], values = [...], kind = ... }, \"initial\" (also as the "
                 "first value) or \"free\""},
        BadInput{"[constraints]\nvolume = [1, 2, 3, 2]",
                 "case.toml:2:10: constraints.volume = [ 1, 2, 3, 2 ]: must have t0 < t1"},
        BadInput{"[constraints]\nphase_fraction = 1.5",
                 "case.toml:2:18: constraints.phase_fraction = 1.5: must be between 0 and 1"},
        BadInput{"[solver]\nlinear_solver = 'umfpak'",
                 "case.toml:2:17: solver.linear_solver = 'umfpak': must be one of \"auto\", "
                 "\"preconditioned\", \"umfpack\", \"klu\", \"mumps\"; did you mean \"umfpack\"?"},
        BadInput{"[phase]\ndirections = [[1, 0]]",
                 "case.toml:2:14: phase.directions = [ [ 1, 0 ] ]: must be an array of arrays of 3 "
                 "numbers"},
        BadInput{"[adaption]\nenabled = true\nmethod = 'bisection'\n[solver]\nmethod = 'minimize'",
                 "case.toml:3:10: adaption.method = bisection: must be local for solver.method = "
                 "minimize"},
        BadInput{"[adaption]\nenabled = true\n[solver]\nmethod = 'semi-implicit'\ntime_step = 1e-4",
                 "case.toml:2:11: adaption.enabled = true: needs solver.method = \"minimize\" or "
                 "\"ida\", not \"semi-implicit\""},
        BadInput{"[solver]\nlinear_solver = 'preconditioned'",
                 "case.toml:2:17: solver.linear_solver = preconditioned: must be auto, umfpack, "
                 "klu or mumps but for solver.method = ida with solver.scheme = variational"},
        BadInput{"[solver]\nscheme = 'variational'\nnewton = 'direct'\n"
                 "linear_solver = 'preconditioned'",
                 "case.toml:4:17: solver.linear_solver = preconditioned: must be auto, umfpack, "
                 "klu or mumps for solver.newton = direct"},
        BadInput{"[adaption]\nn_kappa = 3",
                 "case.toml:2:11: adaption.n_kappa = 3: means nothing with adaption.method = "
                 "\"local\""},
        BadInput{"[adaption]\nmethod = 'bisection'\nconformal_quality = 0.4",
                 "case.toml:3:21: adaption.conformal_quality = 0.4: means nothing with "
                 "adaption.method = \"bisection\""},
        BadInput{"[adaption]\nmethod = 'conformal'\nmin_steps = 3",
                 "case.toml:3:13: adaption.min_steps = 3: means nothing with adaption.method = "
                 "\"conformal\""},
        BadInput{"[adaption]\nmax_nodes = 0",
                 "case.toml:2:13: adaption.max_nodes = 0: must be >= 1"},
        BadInput{"stop = 3", "case.toml:1:8: stop = 3: must be a table"}));

TEST(Config, MalformedTomlIsRefusedWithItsPlace) {
  EXPECT_TRUE(refusal("[solver]\nrtol = = 1").starts_with("case.toml:2:8: "))
      << refusal("[solver]\nrtol = = 1");
}

TEST(Config, ARepeatedKeyIsRefusedWithItsPlace) {
  const std::string message = refusal("[solver]\nrtol = 1\nrtol = 2");
  EXPECT_TRUE(message.starts_with("case.toml:3:")) << message;
  EXPECT_NE(message.find("rtol"), std::string::npos) << message;
}

TEST(Config, AMessageAboutAKeyGetsItsPlace) {
  const RunConfig config = read("[phase]\nangle = 20\n", {"phase.directions=[[0, 0, 0]]"});
  EXPECT_EQ(placed(config, "phase.angle = 20: must be 7"),
            "case.toml:2:9: phase.angle = 20: must be 7");
  EXPECT_EQ(placed(config, "phase.directions[0] = 0: must be 7"),
            "--set phase.directions=[[0, 0, 0]]: phase.directions[0] = 0: must be 7");
  EXPECT_EQ(placed(config, "phase.count = 4: must be 7"), "phase.count = 4: must be 7");
}

TEST(Config, AnUnreadableFileIsAnIoError) {
  EXPECT_THROW((void)read_config("/nonexistent/case.toml", {}), IoError);
  EXPECT_THROW((void)read_config("/", {}), IoError);
}

TEST(Config, OverridesReplaceAndAddValues) {
  const RunConfig config =
      read("[solver]\nrtol = 1e-2\n", {"solver.rtol=1e-4", "damping.kind = fixed",
                                       "constraints.volume=[3, 2, 0, 1]", "title=two words"});
  EXPECT_EQ(config.solver.rtol, 1e-4);
  EXPECT_EQ(config.damping.kind, relax::DampingKind::fixed);
  EXPECT_EQ(config.constraints.targets.of<model::Volume>().schedule.last(), 2);
  EXPECT_EQ(config.title, "two words");
}

TEST(Config, AWrongOverrideIsNamedAsTheUserWroteIt) {
  EXPECT_EQ(refusal("", {"solver.rtol=-1"}), "--set solver.rtol=-1: solver.rtol = -1: must be > 0");
  EXPECT_EQ(refusal("", {"solver.rtl=1"}),
            "--set solver.rtl=1: solver.rtl = 1: unknown key, did you mean \"rtol\"?");
  EXPECT_EQ(refusal("", {"solvr.rtol=1"}),
            "--set solvr.rtol=1: [solvr]: unknown table, did you mean \"solver\"?");
  EXPECT_EQ(refusal("", {"rtol"}), "--set rtol: must be table.key=value");
  EXPECT_TRUE(refusal("", {"solver.rtol=[1"}).starts_with("--set solver.rtol=[1: "));
  EXPECT_EQ(refusal("", {"solver.rtol=1\natol=2"}),
            "--set solver.rtol=1\natol=2: must be one value");
}

TEST(Config, AccuracyIsAPresetForWhatIsNotGiven) {
  const RunConfig draft = read("[solver]\naccuracy = 'draft'");
  EXPECT_EQ(draft.solver.rtol, 1e-2);
  EXPECT_EQ(draft.stop.normal_velocity, 1e-2);
  const RunConfig reference = read("[solver]\nrtol = 1e-4\naccuracy = 'reference'");
  EXPECT_EQ(reference.solver.rtol, 1e-4);
  EXPECT_EQ(reference.stop.normal_velocity, 1e-4);
}

TEST(Config, TheTemplateReadsBackAsTheDefaults) {
  std::ostringstream text;
  write_template(text);
  EXPECT_EQ(to_toml(read(text.str())), to_toml(RunConfig{}));
}

TEST(Config, TheTemplateWithEveryOptionTakenInShowsTheDefaults) {
  std::ostringstream text;
  write_template(text);
  const std::string taken_in =
      std::regex_replace(text.str(), std::regex("(^|\n)#([a-z_]+ = [^<]|\\[)"), "$1$2");
  RunConfig expected;
  expected.phase.emplace();
  EXPECT_EQ(to_toml(read(taken_in)), to_toml(expected));
}

TEST(Config, TheTemplateNamesEveryOption) {
  std::ostringstream text;
  write_template(text);
  for (const char* line :
       {"\n#directions = []", "\n#rtol = 0.001", "\n#every_steps = 5", "\n#enabled = false",
        "\n#reduced_volume = <number, not set>", "\n#end_time = inf", "\n#kind = \"capsule\"",
        "\n#bending_rigidity = [1.0, 1.0]", "\n#volume = \"initial\""}) {
    EXPECT_NE(text.str().find(line), std::string::npos) << line;
  }
}

TEST(Config, TheEffectiveConfigurationReadsBackAsTheSame) {
  const std::string text = to_toml(read(R"(
title = "tab\there"
[shape]
semi_axes = [2, 1.5, 0.1]
[phase]
kind = "spots"
directions = [[1, 0, 0], [0, 1.0, 0.3333333333333333]]
[material]
gaussian_rigidity = [0.1, -1e-300]
reduced_line_tension = 8
[constraints]
volume = [3, 2.5, 0.0, 1]
area = "free"
phase_fraction = 0.3
[solver]
accuracy = "draft"
newton = "direct"
[stop]
max_seconds = 10
)"));
  EXPECT_EQ(to_toml(read(text)), text);
  EXPECT_NE(text.find("title = \"tab\\u0009here\""), std::string::npos);
  EXPECT_NE(text.find("directions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.3333333333333333]]"),
            std::string::npos);
  EXPECT_NE(text.find("volume = [3.0, 2.5, 0.0, 1.0]"), std::string::npos);
  EXPECT_NE(text.find("gaussian_rigidity = [0.1, -1e-300]"), std::string::npos);
}

TEST(Config, QuantitiesMayChangeInTime) {
  using model::Schedule;
  using model::ScheduleKind;
  const RunConfig config = read(R"(
[material]
bending_rigidity = [1, 2, 0, 0.5]
spontaneous_curvature = [{ times = [0, 0.1], values = [0, -4] }, 0.5]
gaussian_rigidity = [[0, 1, 0, 1], { times = [0, 1], values = [0, 2], kind = "stages" }]
line_tension = { values = [1, 3, 2], times = [0, 1, 2], kind = "linear" }
[constraints]
volume = ["initial", 2.6, 0, 0.05]
area = { times = [0, 1, 2], values = ["initial", 12, 11], kind = "stages" }
)");
  const auto& material = config.material;
  const auto stiffer = Schedule::ramp(1, 2, 0, 0.5);
  EXPECT_EQ(material.bending_rigidity, (model::PhaseSchedules{stiffer, stiffer}));
  EXPECT_EQ(material.spontaneous_curvature,
            (model::PhaseSchedules{Schedule::ramp(0, -4, 0, 0.1), 0.5}));
  EXPECT_EQ(material.gaussian_rigidity,
            (model::PhaseSchedules{Schedule::ramp(0, 1, 0, 1),
                                   Schedule::points(ScheduleKind::stages, {0, 1}, {0, 2})}));
  EXPECT_EQ(material.line_tension, Schedule::points(ScheduleKind::linear, {0, 1, 2}, {1, 3, 2}));
  EXPECT_TRUE(config.constraints.targets.of<model::Volume>().begins_at_start);
  EXPECT_EQ(config.constraints.targets.of<model::Volume>().schedule.value(0.05), 2.6);
  EXPECT_TRUE(config.constraints.targets.of<model::Area>().begins_at_start);
  EXPECT_EQ(config.constraints.targets.of<model::Area>().schedule.value(1.5), 12);
}

TEST(Config, QuantitiesThatChangeInTimeReadBackAsTheSame) {
  const std::string text = to_toml(read(R"(
[material]
spontaneous_curvature = [{ times = [0, 0.1, 0.2], values = [0, -4, -3] }, 0.5]
line_tension = { times = [0, 1], values = [1, 3], kind = "stages" }
[constraints]
volume = ["initial", 2.6, 0, 0.05]
)"));
  EXPECT_EQ(to_toml(read(text)), text);
  for (const char* line :
       {"spontaneous_curvature = [{ times = [0.0, 0.1, 0.2], values = [0.0, -4.0, -3.0], kind = "
        "\"linear\" }, 0.5]\n",
        "line_tension = { times = [0.0, 1.0], values = [1.0, 3.0], kind = \"stages\" }\n",
        "volume = [\"initial\", 2.6, 0.0, 0.05]\n"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST(Config, EveryCaseOfTheRepositoryIsRead) {
  int number = 0;
  for (const auto& file : std::filesystem::directory_iterator(VESICA_CASES_DIR)) {
    EXPECT_NO_THROW((void)read_config(file.path().string(), {})) << file.path();
    ++number;
  }
  EXPECT_GE(number, 4);
}

}  // namespace
}  // namespace vesica::config
