// 2. An observer and a controller
// ===============================
//
// Introduction
// ------------
// An observer looks at a run and changes nothing; a controller looks and answers with requests. Two
// questions about a relaxing vesicle need them. How does the energy fall in time? We record it:
// along a gradient flow it can only fall, when volume and area stay what they are. And: when does
// it hardly fall any more? We stop the run where five steps gain less than 0.1 %, because the last
// stretch of a relaxation, in which the shape hardly changes, takes many of its steps.
//
// The commented program
// ---------------------
#include <algorithm>
#include <atomic>
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
    energies_.push_back(view.diagnostics.energy.total());
    times_.push_back(view.state.time);
  }

  // `finish` comes once, however the run ends.
  void finish(const relax::StepView&, const relax::Outcome& outcome) override {
    std::printf("%s\n", outcome.reason.c_str());
    for (std::size_t i = 0; i < energies_.size(); i += 4)
      std::printf("t = %.3e   F = %.4f\n", times_[i], energies_[i]);
  }

  // Whether no energy is above the one before by more than a relative `tolerance`.
  [[nodiscard]] bool is_falling(double tolerance) const {
    const auto rises = [&](double before, double after) {
      return after > (1 + tolerance) * before;
    };
    return std::adjacent_find(energies_.begin(), energies_.end(), rises) == energies_.end();
  }

 private:
  std::vector<double> times_;
  std::vector<double> energies_;
};

// A controller is asked at the same moments. It returns requests, which the loop carries out before
// the next step: relax::Stop, relax::SetDamping or relax::Remesh. An empty list means: go on.
// Other questions (a failed step, a limit, an equilibrium) have functions of their own.
class StopWhenSlow final : public relax::Controller {
 public:
  [[nodiscard]] std::vector<relax::Request> respond(const relax::StepView& view) override {
    energies_.push_back(view.diagnostics.energy.total());
    if (energies_.size() < 6) return {};
    const double now = energies_.back();
    const double gain = energies_[energies_.size() - 6] - now;
    if (gain > 1e-3 * now) return {};
    return {relax::Stop{relax::RunStatus::stopped, "five steps gained less than 0.1 % of energy"}};
  }

 private:
  std::vector<double> energies_;
};

}  // namespace

int main() {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::ellipsoid;
  config.shape.semi_axes = {2, 0.7, 0.7};
  config.shape.resolution = 4;
  config.solver.method = solve::Method::ida;  // we ask for times, so we follow the flow

  // What is not set keeps its default: volume and area are held at what the start has.
  //
  // Both are lent to the run and must outlive it. Lines of progress go to any stream. A number
  // other than zero in `interrupt` would end the run after the present step; a signal handler or
  // another thread can store it there.
  EnergyRecord record;
  StopWhenSlow slow;
  const std::atomic<int> signal{0};
  run::Options options;
  options.writes_files = false;
  options.progress = &std::cout;
  options.observers = {&record};
  options.controllers = {&slow};
  options.interrupt = &signal;
  const run::Result result = run::run(config, options);

  // Results
  // -------
  // The status is `stopped`, the reason is our own sentence, and the recorded energies fall
  // from 38.4 to 35.2, up to the relative tolerance of the integrator: volume and area are held to
  // it on the way, and the energy follows them. The state that comes back is that of the last step,
  // and may be the start of another run.
  const bool is_right = result.verdict.outcome.status == relax::RunStatus::stopped &&
                        record.is_falling(config.solver.rtol) && result.state.time > 0;
  return is_right ? 0 : 1;
}
