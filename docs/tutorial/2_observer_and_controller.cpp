// 2. An observer and a controller
// ===============================
//
// Introduction
// ------------
// An observer looks at a run and changes nothing; a controller looks and answers with requests. Two
// questions about the vesicle of the first program need them. How does the energy fall in time? We
// record it: along a gradient flow it can only fall, once the constraints are met. And: when is the
// vesicle within 1 % of the energy 29.89902 of the prolate? We stop the run there, because the last
// stretch of a relaxation, where the shape hardly changes any more, takes many of its steps.
//
// The commented program
// ---------------------
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <vector>
#include <vesica/run/run.hpp>

namespace {

using namespace vesica;

// An observer is called after every accepted step, and once before the first. The view holds the
// state (time, mesh, positions, order parameter), the report of the step and what was measured.
class EnergyRecord final : public relax::Observer {
 public:
  void observe(const relax::StepView& view) override {
    if (std::abs(view.diagnostics.constraint_errors.of<model::Volume>().value_or(0)) > 1e-4) return;
    energies_.push_back(view.diagnostics.energy.total());
    times_.push_back(view.state.time);
  }

  // `finish` comes once, however the run ends.
  void finish(const relax::StepView&, const relax::Outcome& outcome) override {
    std::printf("%s\n", outcome.reason.c_str());
    for (std::size_t i = 0; i < energies_.size(); i += 4)
      std::printf("t = %.3e   F = %.4f\n", times_[i], energies_[i]);
  }

  [[nodiscard]] bool is_falling() const {
    return energies_.size() > 3 && std::is_sorted(energies_.rbegin(), energies_.rend());
  }

 private:
  std::vector<double> times_;
  std::vector<double> energies_;
};

// A controller is asked at the same moments. It returns requests, which the loop carries out before
// the next step: relax::Stop, relax::SetDamping or relax::Remesh. An empty list means: go on.
// Others questions (a failed step, a limit, an equilibrium) have functions of their own.
class StopNearEnergy final : public relax::Controller {
 public:
  explicit StopNearEnergy(double energy) : energy_(energy) {}

  [[nodiscard]] std::vector<relax::Request> respond(const relax::StepView& view) override {
    if (view.diagnostics.energy.total() > 1.01 * energy_) return {};
    return {relax::Stop{relax::RunStatus::stopped, "within 1 % of the energy of the prolate"}};
  }

 private:
  double energy_;
};

}  // namespace

int main() {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::ellipsoid;
  config.shape.semi_axes = {2, 0.7, 0.7};
  config.shape.resolution = 4;
  config.constraints.reduced_volume = 0.9;

  // Both are lent to the run and must outlive it. Lines of progress go to any stream. A number
  // other than zero in `interrupt` would end the run after the present step; a signal handler or
  // another thread can store it there.
  EnergyRecord record;
  StopNearEnergy near(29.89902);
  const std::atomic<int> signal{0};
  run::Options options;
  options.writes_files = false;
  options.progress = &std::cout;
  options.observers = {&record};
  options.controllers = {&near};
  options.interrupt = &signal;
  const run::Result result = run::run(config, options);

  // Results
  // -------
  // The status is `stopped`, the reason is our own sentence, and the recorded energies fall. The
  // state that comes back is that of the last step, and may be the start of another run.
  const bool is_right = result.verdict.outcome.status == relax::RunStatus::stopped &&
                        record.is_falling() && result.state.time > 0;
  return is_right ? 0 : 1;
}
