#pragma once

#include <filesystem>

#include "fake_run.hpp"
#include "vesica/io/trajectory_writer.hpp"

namespace vesica::io {

/// Writes a made-up run of twelve steps with frames 0 to 3.
inline relax::Verdict write_fake_run(const std::filesystem::path& folder, relax::RunStatus status,
                                     int signal = 0) {
  config::RunConfig config;
  config.solver.method = solve::Method::ida;
  config.title = "made up";
  config.phase.emplace();
  config.output.directory = folder.string();
  problem::State state = fake_state();
  solve::StepReport report = fake_report(0);
  relax::Outcome outcome = fake_outcome(status);
  outcome.signal = signal;
  outcome.diagnostics.domains = {{1, 3, 6.5}, {1, 2, 5}, {2, 7, 11}};
  outcome.events = {{3, 0.5, "domains of phase 1: 1 -> 2"}};
  outcome.mesh_changes.resize(2);
  const measure::Diagnostics measured = fake_diagnostics();
  TrajectoryWriter writer(folder, config, setup::case_of(config, fake_state()));
  for (long step = 0; step <= 12; ++step) {
    report = fake_report(step);
    state.time = 0.125 * static_cast<double>(step);
    state.values.positions *= 1.001;
    writer.observe({state, report, measured});
  }
  writer.finish({state, report, measured}, outcome);
  return writer.verdict().value();
}

}  // namespace vesica::io
