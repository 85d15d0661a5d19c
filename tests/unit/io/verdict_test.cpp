#include <gtest/gtest.h>

#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>
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
  verdict.velocity = verdict.outcome.diagnostics.velocity.over(2);
  verdict.outcome.mesh_changes.resize(3);
  verdict.shape.reduced_volume = std::numeric_limits<double>::quiet_NaN();
  verdict.shape.domains_1 = 1;
  verdict.num_nodes = 18;
  verdict.num_triangles = 8;
  return verdict;
}

nlohmann::json flat(const relax::Verdict& verdict) {
  return nlohmann::json::parse(to_json(verdict)).flatten();
}

TEST(Verdict, JsonHoldsTheNumbersAndNullForWhatIsAbsent) {
  const nlohmann::json json = flat(fake_verdict(RunStatus::converged));
  const nlohmann::json expected = {{"/status", "converged"},
                                   {"/reason", "because of the \"test\""},
                                   {"/time", 0.1},
                                   {"/energy/total", 58.75},
                                   {"/energy/bending", 50.5},
                                   {"/energy/gaussian", 0.0},
                                   {"/energy/line", 8.25},
                                   {"/multipliers/volume", 27.5},
                                   {"/multipliers/area", -9.25},
                                   {"/multipliers/phase", nullptr},
                                   {"/constraints/volume", 1e-9},
                                   {"/constraints/area", -2e-9},
                                   {"/constraints/phase", nullptr},
                                   {"/normal_velocity", 0.0015},
                                   {"/normal_velocity_plain", 0.0025},
                                   {"/drift", 0.002},
                                   {"/mesh/quality", 0.5},
                                   {"/mesh/quality_initial", 0.625},
                                   {"/mesh/quality_smallest", 0.375},
                                   {"/mesh/nodes", 18},
                                   {"/mesh/triangles", 8},
                                   {"/mesh/adaptions", 0},
                                   {"/mesh/remeshings", 3},
                                   {"/shape/reduced_volume", nullptr},
                                   {"/shape/neck_radius", nullptr},
                                   {"/domains/phase_1", 1},
                                   {"/domains/phase_2", nullptr},
                                   {"/polish/iterations", nullptr},
                                   {"/polish/lowest_curvature", nullptr},
                                   {"/counts/steps", 12},
                                   {"/counts/newton", 24}};
  for (const auto& [pointer, value] : expected.items()) {
    if (value.is_number_float()) {
      EXPECT_NEAR(json.at(pointer).get<double>(), value.get<double>(), 1e-14) << pointer;
    } else {
      EXPECT_EQ(json.at(pointer), value) << pointer;
    }
  }
}

TEST(Verdict, JsonIsForPeopleToo) {
  const std::string json = to_json(fake_verdict(RunStatus::converged));
  EXPECT_TRUE(json.starts_with("{\n  \"status\"")) << json;
  EXPECT_NE(json.find("\"energy\": {\n    \"total\": 58.75,\n    \"bending\""), std::string::npos)
      << json;
  EXPECT_TRUE(json.ends_with("\n}\n")) << json;
}

TEST(Verdict, HoldsAreasAndBoundariesOfTheDomainsPhaseByPhase) {
  relax::Verdict verdict = fake_verdict(RunStatus::converged);
  const auto domains = [&] { return nlohmann::json::parse(to_json(verdict)).at("domains"); };
  EXPECT_EQ(domains().at("areas").dump(), R"({"phase_1":[],"phase_2":[]})");
  verdict.outcome.diagnostics.domains = {{1, 3, 6.5}, {1, 2, 5}, {2, 7, 11}};
  EXPECT_EQ(domains().at("areas").dump(), R"({"phase_1":[3.0,2.0],"phase_2":[7.0]})");
  EXPECT_EQ(domains().at("boundary_lengths").dump(), R"({"phase_1":[6.5,5.0],"phase_2":[11.0]})");
}

TEST(Verdict, ListsTheEvents) {
  relax::Verdict verdict = fake_verdict(RunStatus::converged);
  const auto events = [&] { return nlohmann::json::parse(to_json(verdict)).at("events").dump(); };
  EXPECT_EQ(events(), "[]");
  verdict.outcome.events = {{3, 0.5, "domains of phase 1: 2 -> 1"}, {4, 0.75, "remeshed"}};
  EXPECT_EQ(events(), R"([{"step":3,"time":0.5,"what":"domains of phase 1: 2 -> 1"},)"
                      R"({"step":4,"time":0.75,"what":"remeshed"}])");
}

TEST(Verdict, StatusHasTheNamesOfTheInterface) {
  EXPECT_EQ(name_of(RunStatus::converged), "converged");
  EXPECT_EQ(name_of(RunStatus::end_time), "time limit");
  EXPECT_EQ(name_of(RunStatus::time_limit), "time limit");
  EXPECT_EQ(name_of(RunStatus::step_limit), "step limit");
  EXPECT_EQ(name_of(RunStatus::neck_closes), "neck closes");
  EXPECT_EQ(name_of(RunStatus::budding), "budding");
  EXPECT_EQ(name_of(RunStatus::self_intersection), "self-intersection");
  EXPECT_EQ(name_of(RunStatus::unresolved), "unresolved");
  EXPECT_EQ(name_of(RunStatus::interrupted), "interrupted");
  EXPECT_EQ(name_of(RunStatus::numerical_failure), "numerical failure");
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
  EXPECT_EQ(status(RunStatus::unresolved), 1);
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
