#include <gtest/gtest.h>

#include <csignal>
#include <limits>
#include <sstream>
#include <string>

#include "fake_run.hpp"
#include "vesica/io/verdict_files.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {
namespace {

using relax::RunStatus;

relax::Verdict fake_verdict(RunStatus status) {
  relax::Verdict verdict;
  verdict.outcome = fake_outcome(status);
  verdict.method = "ida";
  verdict.time = 0.1;
  verdict.multipliers = {27.5, -9.25, std::nullopt};
  verdict.shape.characteristic_radius = 2;
  verdict.shape.reduced_volume = std::numeric_limits<double>::quiet_NaN();
  verdict.shape.domains_1 = 1;
  verdict.num_nodes = 18;
  verdict.num_triangles = 8;
  return verdict;
}

TEST(Verdict, JsonHoldsTheNumbersAndNullForWhatIsAbsent) {
  const std::string json = to_json(fake_verdict(RunStatus::converged));
  for (const char* part :
       {"\"status\": \"converged\",", "\"reason\": \"because of the \\\"test\\\"\",",
        "\"time\": 0.1,",
        "\"energy\": {\n    \"total\": 58.75,\n    \"bending\": 50.5,\n    \"gaussian\": 0,\n    "
        "\"line\": 8.25\n  },",
        "\"multipliers\": {\n    \"volume\": 27.5,\n    \"area\": -9.25,\n    \"phase\": null\n  "
        "},",
        "\"constraints\": {\n    \"volume\": 1e-09,\n    \"area\": -2e-09,\n    \"phase\": null\n  "
        "},",
        "\"normal_velocity\": 0.0015,", "\"normal_velocity_plain\": 0.0025,", "\"drift\": 0.002,",
        "\"quality\": 0.5,", "\"quality_initial\": 0.625,", "\"quality_smallest\": 0.375,",
        "\"reduced_volume\": null,", "\"neck_radius\": null,",
        "\"phase_1\": 1,\n    \"phase_2\": null", "\"steps\": 12,", "\"newton\": 24,",
        "\"nodes\": 18,", "\"triangles\": 8,"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << " is not in\n" << json;
  }
  EXPECT_TRUE(json.starts_with("{\n  \"status\"")) << json;
  EXPECT_TRUE(json.ends_with("\n  }\n}\n")) << json;
}

TEST(Verdict, CountsTheChangesOfTheMesh) {
  relax::Verdict verdict = fake_verdict(RunStatus::converged);
  verdict.outcome.mesh_changes.resize(3);
  EXPECT_NE(to_json(verdict).find("\"remeshings\": 3"), std::string::npos) << to_json(verdict);
}

TEST(Verdict, HoldsAreasAndBoundariesOfTheDomainsPhaseByPhase) {
  relax::Verdict verdict = fake_verdict(RunStatus::converged);
  const std::string none = to_json(verdict);
  EXPECT_NE(none.find("\"areas\": {\n      \"phase_1\": [],"), std::string::npos) << none;
  verdict.outcome.diagnostics.domains = {{1, 3, 6.5}, {1, 2, 5}, {2, 7, 11}};
  const std::string json = to_json(verdict);
  for (const char* part :
       {"\"areas\": {\n      \"phase_1\": [3, 2],\n      \"phase_2\": [7]\n    },",
        "\"boundary_lengths\": {\n      \"phase_1\": [6.5, 5],\n      \"phase_2\": [11]\n    }\n  "
        "},"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << " is not in\n" << json;
  }
}

TEST(Verdict, ListsTheEvents) {
  relax::Verdict verdict = fake_verdict(RunStatus::converged);
  EXPECT_NE(to_json(verdict).find("\"events\": [],"), std::string::npos);
  verdict.outcome.events = {{3, 0.5, "domains of phase 1: 2 -> 1"}, {4, 0.75, "remeshed"}};
  const std::string json = to_json(verdict);
  const char* events =
      "\"events\": [\n    {\n      \"step\": 3,\n      \"time\": 0.5,\n"
      "      \"what\": \"domains of phase 1: 2 -> 1\"\n    },\n    {\n      \"step\": 4,";
  EXPECT_NE(json.find(events), std::string::npos) << json;
}

TEST(Verdict, StatusHasTheNamesOfTheInterface) {
  EXPECT_EQ(relax::status_name(RunStatus::converged), "converged");
  EXPECT_EQ(relax::status_name(RunStatus::end_time), "time limit");
  EXPECT_EQ(relax::status_name(RunStatus::time_limit), "time limit");
  EXPECT_EQ(relax::status_name(RunStatus::step_limit), "step limit");
  EXPECT_EQ(relax::status_name(RunStatus::neck_closes), "neck closes");
  EXPECT_EQ(relax::status_name(RunStatus::budding), "budding");
  EXPECT_EQ(relax::status_name(RunStatus::self_intersection), "self-intersection");
  EXPECT_EQ(relax::status_name(RunStatus::interrupted), "interrupted");
  EXPECT_EQ(relax::status_name(RunStatus::numerical_failure), "numerical failure");
}

TEST(Verdict, ExitStatusTellsHowTheRunEnded) {
  const auto status = [](RunStatus run_status, int signal = 0) {
    relax::Outcome outcome = fake_outcome(run_status);
    outcome.signal = signal;
    return exit_status(outcome);
  };
  EXPECT_EQ(status(RunStatus::converged), 0);
  EXPECT_EQ(status(RunStatus::end_time), 1);
  EXPECT_EQ(status(RunStatus::time_limit), 1);
  EXPECT_EQ(status(RunStatus::step_limit), 1);
  EXPECT_EQ(status(RunStatus::stopped), 1);
  EXPECT_EQ(status(RunStatus::neck_closes), 1);
  EXPECT_EQ(status(RunStatus::budding), 1);
  EXPECT_EQ(status(RunStatus::self_intersection), 1);
  EXPECT_EQ(status(RunStatus::numerical_failure), 3);
  EXPECT_EQ(status(RunStatus::interrupted, SIGINT), 130);
  EXPECT_EQ(status(RunStatus::interrupted, SIGTERM), 143);
}

TEST(Verdict, TheTableForPeopleLeavesOutWhatIsAbsent) {
  std::ostringstream out;
  io::print_verdict(out, fake_verdict(RunStatus::step_limit));
  const std::string text = out.str();
  EXPECT_TRUE(text.starts_with("step limit: because of the \"test\"\n")) << text;
  EXPECT_NE(text.find("  energy            total 58.75, bending 50.5, gaussian 0, line 8.25\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  multipliers       volume 27.5, area -9.25\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  domains           phase 1: 1\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("neck"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

}  // namespace
}  // namespace vesica::io
