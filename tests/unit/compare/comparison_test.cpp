#include "vesica/compare/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fake_run.hpp"
#include "flat_json.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::compare {
namespace {

using relax::RunStatus;

/// A run that ended in the made-up state.
ComparedRun fake_run(std::string name, RunStatus status = RunStatus::converged) {
  ComparedRun run;
  run.name = std::move(name);
  run.folder = "out/" + run.name;
  run.state = io::fake_state();
  run.verdict.outcome = io::fake_outcome(status);
  run.verdict.method = "ida";
  run.verdict.multipliers = run.state.values.multipliers;
  run.verdict.shape.characteristic_radius = 1;
  run.verdict.shape.domains_1 = 1;
  run.verdict.shape.domains_2 = 1;
  run.history = {{0, 1, 2}, {0, 0.25, 0.5}, {70, 60, 58.75}};
  return run;
}

Difference difference_of(const ComparedRun& first, const ComparedRun& second) {
  return compare({first, second}).differences.at(0);
}

TEST(Comparison, EqualRunsFoundTheSameEquilibrium) {
  ComparedRun other = fake_run("minimize");
  *other.verdict.outcome.diagnostics.energy.of<model::BendingEnergy>() += 58.75e-6;
  other.state.values.multipliers.of<model::Volume>() = 27.5 / (1 - 1e-3);
  const Difference difference = difference_of(fake_run("flow"), other);
  EXPECT_EQ(difference.same_equilibrium, true);
  EXPECT_NEAR(difference.energy, 58.75e-6, 1e-12);
  EXPECT_NEAR(difference.relative_energy, 1e-6, 1e-11);
  EXPECT_NEAR(*difference.multipliers.of<model::Volume>(), 1e-3, 1e-12);
  EXPECT_EQ(difference.multipliers.of<model::Area>(), 0);
  EXPECT_FALSE(difference.multipliers.of<model::PhaseDifference>());
  EXPECT_LT(difference.shape.l2, 1e-9);
  EXPECT_TRUE(difference.conclusion.starts_with(
      "flow and minimize found the same equilibrium: energies agree to 1.0e-06 (relative)"))
      << difference.conclusion;
}

TEST(Comparison, EveryCriterionAloneTellsEquilibriaApart) {
  const ComparedRun first = fake_run("flow");
  ComparedRun energy = fake_run("minimize");
  *energy.verdict.outcome.diagnostics.energy.of<model::BendingEnergy>() *= 0.99;
  ComparedRun shape = fake_run("minimize");
  shape.state.values.positions.col(0) *= 1.1;
  ComparedRun phase = fake_run("minimize");
  phase.state.values.order_parameter.array() += 0.2;
  ComparedRun domains = fake_run("minimize");
  domains.verdict.shape.domains_2 = 2;
  const auto expect = [&](const ComparedRun& second, const std::string& part) {
    const Difference difference = difference_of(first, second);
    EXPECT_EQ(difference.same_equilibrium, false) << part;
    EXPECT_NE(difference.conclusion.find(part), std::string::npos) << difference.conclusion;
  };
  expect(energy, "saddle), minimize the lower one: energies differ by 8.6e-03");
  expect(shape, "shapes by ");
  expect(phase, "phase fields by 2.0e-01 (tolerance 0.05)");
  expect(domains, "numbers of domains: 1 + 1 and 1 + 2");
}

TEST(Comparison, AnEnergyThatIsNoNumberIsNoAgreement) {
  ComparedRun other = fake_run("minimize");
  *other.verdict.outcome.diagnostics.energy.of<model::BendingEnergy>() = NAN;
  EXPECT_EQ(difference_of(fake_run("flow"), other).same_equilibrium, false);
}

TEST(Comparison, RunsThatHaveNotConvergedLeaveTheQuestionOpen) {
  const Difference difference =
      difference_of(fake_run("flow"), fake_run("minimize", RunStatus::step_limit));
  EXPECT_FALSE(difference.same_equilibrium);
  EXPECT_NE(difference.conclusion.find("minimize has not converged (step limit)"),
            std::string::npos)
      << difference.conclusion;
}

TEST(Comparison, TheExitStatusIsTheWorstOfTheRuns) {
  const auto status = [](RunStatus first, RunStatus second) {
    return exit_status(compare({fake_run("flow", first), fake_run("minimize", second)}));
  };
  EXPECT_EQ(status(RunStatus::converged, RunStatus::converged), 0);
  EXPECT_EQ(status(RunStatus::step_limit, RunStatus::converged), 1);
  EXPECT_EQ(status(RunStatus::step_limit, RunStatus::numerical_failure), 3);
  EXPECT_EQ(status(RunStatus::interrupted, RunStatus::numerical_failure), 130);
}

TEST(Comparison, JsonHoldsTheVerdictsAndTheDifferences) {
  const test::TemporaryFolder folder;
  ComparedRun other = fake_run("minimize");
  *other.verdict.outcome.diagnostics.energy.of<model::BendingEnergy>() = 49.5;
  io::write_text_file(folder.path() / "comparison.json",
                      io::to_json(compare({fake_run("flow"), other, fake_run("weak_form")})));
  const auto json = test::flat_json(folder.path() / "comparison.json");
  EXPECT_EQ(json.at("/flow/energy/bending"), 50.5);
  EXPECT_EQ(json.at("/minimize/energy/bending"), 49.5);
  EXPECT_EQ(json.at("/weak_form/status"), "converged");
  EXPECT_EQ(json.at("/minimize/folder"), "out/minimize");
  EXPECT_EQ(json.at("/flow/counts/steps"), 12);
  EXPECT_EQ(json.at("/difference/energy/absolute"), -1);
  EXPECT_NEAR(json.at("/difference/energy/relative").get<double>(), -1 / 58.75, 1e-14);
  EXPECT_EQ(json.at("/difference/multipliers/volume"), 0);
  EXPECT_TRUE(json.at("/difference/multipliers/phase").is_null());
  EXPECT_LT(json.at("/difference/shape_l2"), 1e-9);
  EXPECT_LT(json.at("/difference/shape_hausdorff"), 1e-9);
  EXPECT_LT(json.at("/difference/phase_l2"), 1e-8);
  EXPECT_EQ(json.at("/difference/same_equilibrium"), false);
  EXPECT_EQ(json.at("/difference_weak_form/same_equilibrium"), true);
}

/// Every run of blanks as one.
std::string squeezed(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' || !result.ends_with(' ')) result += c;
  return result;
}

TEST(Comparison, TheTableHasAColumnForEachRunAndLeavesOutWhatIsAbsent) {
  std::ostringstream out;
  ComparedRun other = fake_run("minimize");
  *other.verdict.outcome.diagnostics.energy.of<model::BendingEnergy>() = 50.25;
  other.verdict.shape.domains_1.reset();
  io::print_comparison(out, compare({fake_run("flow"), other}));
  const std::string text = squeezed(out.str());
  for (const char* line :
       {" flow minimize\n", " status converged converged\n", " energy 58.75 58.5\n",
        " multiplier volume 27.5 27.5\n", " domains, phase 1 + 2 1 + 1 -\n", " steps 12 12\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << " is not in\n" << out.str();
  }
  EXPECT_EQ(text.find("neck"), std::string::npos) << text;
  EXPECT_NE(text.find("minimize - flow: energy -2.500e-01 (relative -4.26e-03)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nflow and minimize found different equilibria"), std::string::npos) << text;
}

TEST(Comparison, WritesAProfileAndAHistoryForEachRun) {
  const test::TemporaryFolder folder;
  ComparedRun other = fake_run("minimize");
  other.state.values.positions.rowwise() += Eigen::RowVector3d(5, 0, 0);  // moved back for the cut
  const Comparison comparison = compare({fake_run("flow"), other});
  io::write_comparison(folder.path(), comparison);
  for (const std::string name : {"flow", "minimize"}) {
    std::ifstream profile(folder.path() / ("profile_" + name + ".csv"));
    std::string line;
    std::getline(profile, line);
    EXPECT_EQ(line, "# loop,along,across,order_parameter");
    int num_points = 0;
    while (std::getline(profile, line) && !line.empty()) {
      std::istringstream numbers(line);
      double loop = 0, along = 0, across = 0;
      char comma = 0;
      numbers >> loop >> comma >> along >> comma >> across;
      EXPECT_NEAR(std::hypot(along, across), 1, 0.05);
      ++num_points;
    }
    EXPECT_GT(num_points, 8);
    std::ostringstream energies;
    energies << std::ifstream(folder.path() / ("energy_" + name + ".csv")).rdbuf();
    EXPECT_EQ(energies.str(), "# step,seconds,energy\n0,0,70\n1,0.25,60\n2,0.5,58.75\n");
  }
  EXPECT_THROW(io::check_comparison_folder(folder.path(), false), ConfigError);
  EXPECT_NO_THROW(io::check_comparison_folder(folder.path(), true));
}

TEST(Comparison, ARunThatCouldNotBeginIsLeftOutOfTheEnergyPlot) {
  ComparedRun other = fake_run("minimize", RunStatus::numerical_failure);
  other.history = {{0}, {0}, {NAN}};
  const std::string script = io::plot_script(compare({fake_run("flow"), other}));
  EXPECT_NE(script.find("lowest = 58.75\n"), std::string::npos) << script;
  EXPECT_NE(script.find("energy_flow.csv"), std::string::npos) << script;
  EXPECT_EQ(script.find("energy_minimize.csv"), std::string::npos) << script;
  EXPECT_NE(script.find("profile_minimize.csv"), std::string::npos) << script;
}

TEST(Comparison, WithoutGnuplotThereIsASentenceInPlaceOfPictures) {
  const test::TemporaryFolder folder;
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  const auto failure = io::draw_comparison(folder.path());
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->find("gnuplot is not installed"), std::string::npos) << *failure;
}

}  // namespace
}  // namespace vesica::compare
