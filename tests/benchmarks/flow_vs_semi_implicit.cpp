// IDA's flow against the paper's fixed-step scheme on Table 1, eps = 0.3: one run, side by side.
//
//   benchmark_flow_vs_semi_implicit [resolution ...] [--full]
//
// Resolutions (default 4 6 8) are squares along a cube edge, N = 72 m^2 + 2. The fixed-step run is
// complete on the first mesh and extrapolated from its first 100 steps on the others, unless --full
// is given. Seconds are those of the steppers; diagnostics are not counted.
// "CPU" is the processor time of all threads.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fixed_step_runs.hpp"

namespace vesica {
namespace {

constexpr double end_time = 0.45;
constexpr double comparison_time = 0.05;
constexpr double paper_step = 1e-4;  // (eps/30)^2
constexpr int sampled_steps = 100;

/// Wall-clock seconds, and processor seconds of all threads, which other programs disturb less.
struct Seconds {
  double wall = 0;
  double processor = 0;

  friend Seconds operator*(const Seconds& a, double factor) {
    return {a.wall * factor, a.processor * factor};
  }
};

/// Adds what `body` takes to `sum`.
template <class Body>
auto timed(Seconds& sum, Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  const auto processor_start = std::clock();
  auto result = body();
  sum.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sum.processor += static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  return result;
}

struct Result {
  Seconds seconds;
  double steps = 0;
  double factorisations = 0;
  bool is_extrapolated = false;
  std::optional<double> energy;
  double volume_multiplier = 0;
};

/// Steps with the damping controller to the end time; only the stepper is timed. The first
/// `max_steps` are extrapolated when they do not reach it.
Result run(const test::RelaxationCase& cigar, const solve::SolverOptions& options,
           relax::DampingKind damping_kind, long max_steps) {
  Result result;
  const auto stepper =
      timed(result.seconds, [&] { return run::make_stepper(options, cigar.model, cigar.start); });
  relax::DampingOptions damping_options;
  damping_options.kind = damping_kind;
  relax::DampingController damping(damping_options, problem::scales_of(cigar.model, cigar.start));
  const auto& state = stepper->state();
  solve::StepReport report;
  while (true) {
    const auto diagnostics = measure::measure(cigar.model, state);
    for (const auto& request : damping.respond({state, report, diagnostics}))
      stepper->set_damping(std::get<relax::SetDamping>(request).alpha);
    if (state.time >= end_time || report.counts.steps >= max_steps) break;
    report = timed(result.seconds, [&] { return stepper->step(end_time); });
    if (report.status == solve::StepStatus::failed) {
      fmt::print("{}\n", report.reason);
      break;
    }
  }
  result.is_extrapolated = state.time < end_time;
  if (!result.is_extrapolated) {
    report = timed(result.seconds, [&] { return stepper->finish(); });
    result.energy = measure::measure(cigar.model, state).energy.total();
  }
  const double factor = result.is_extrapolated ? end_time / state.time : 1;
  result.seconds = result.seconds * factor;
  result.steps = static_cast<double>(report.counts.steps) * factor;
  result.factorisations = static_cast<double>(report.counts.factorisations) * factor;
  result.volume_multiplier = *state.values.multipliers.of<model::Volume>();
  return result;
}

void print_row(Eigen::Index nodes, std::string_view method, const Result& result,
               const Seconds& ida) {
  std::string errors = "- | -";
  if (result.energy) {
    errors = fmt::format("{:+.2e} | {:+.2e}", *result.energy - test::table_1_energy,
                         result.volume_multiplier - test::table_1_volume_multiplier);
  }
  fmt::print("| {} | {}{} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {} |\n", nodes,
             method, result.is_extrapolated ? " *" : "", result.steps, result.factorisations,
             result.seconds.wall, result.seconds.processor, result.seconds.wall / ida.wall,
             result.seconds.processor / ida.processor, errors);
  std::fflush(stdout);
}

void compare_runs(int resolution, bool is_complete) {
  const auto cigar = test::table_1_case(resolution);
  const auto nodes = cigar.start.values.positions.rows();
  const long all = std::numeric_limits<long>::max();
  const auto ida = run(cigar, {}, relax::DampingKind::speed, all);
  print_row(nodes, "ida", ida, ida.seconds);
  print_row(nodes, "semi-implicit",
            run(cigar, test::semi_implicit_options(paper_step), relax::DampingKind::paper,
                is_complete ? all : sampled_steps),
            ida.seconds);
  print_row(nodes, "semi-implicit, beta eliminated",
            run(cigar, test::semi_implicit_options(paper_step, false), relax::DampingKind::paper,
                sampled_steps),
            ida.seconds);
}

/// Energy at the comparison time with alpha = 1, and the seconds that it took.
struct Sample {
  double energy = 0;
  Seconds seconds;
};

Sample sample(const test::RelaxationCase& cigar, const solve::SolverOptions& options) {
  Sample result;
  const auto state =
      timed(result.seconds, [&] { return test::state_at(cigar, options, comparison_time, 1); });
  result.energy = measure::measure(cigar.model, state).energy.total();
  return result;
}

void print_sample(std::string_view method, double tau, double error, const Seconds& seconds,
                  const Seconds& ida) {
  fmt::print("| {} | {:.1e} | {:.1e} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", method, tau, error,
             seconds.wall, seconds.processor, seconds.wall / ida.wall,
             seconds.processor / ida.processor);
  std::fflush(stdout);
}

/// The largest step whose energy at t = 0.05 is as accurate as IDA's. Both integrate the same
/// semi-discrete equations here (beta eliminated, alpha = 1), so the reference, IDA with rtol 1e-7,
/// measures the error in time alone. Steps are halved down to the paper's; below it the error is
/// continued at first order.
void compare_at_equal_accuracy(int resolution) {
  const auto cigar = test::undisturbed_cigar(resolution);
  solve::SolverOptions ida;
  ida.final_constraint_solve = false;
  solve::SolverOptions accurate = ida;
  accurate.rtol = accurate.atol = 1e-7;
  const double reference = sample(cigar, accurate).energy;
  const auto normal = sample(cigar, ida);
  const double goal = std::abs(normal.energy - reference);
  fmt::print("\nEqual accuracy in time, N = {}, energy at t = {}:\n\n",
             cigar.start.values.positions.rows(), comparison_time);
  fmt::print("| method | tau | error of F in time | seconds | CPU seconds | times IDA | CPU |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  print_sample("ida, rtol 1e-3", 0, goal, normal.seconds, normal.seconds);
  double tau = 64 * paper_step;
  Sample last;
  double error = std::numeric_limits<double>::infinity();
  for (; tau > 0.9 * paper_step; tau /= 2) {
    last = sample(cigar, test::semi_implicit_options(tau, false));
    error = std::abs(last.energy - reference);
    print_sample("semi-implicit", tau, error, last.seconds, normal.seconds);
    if (error <= goal) return;
  }
  const double factor = error / goal;
  print_sample("semi-implicit *", 2 * tau / factor, goal, last.seconds * factor, normal.seconds);
}

}  // namespace
}  // namespace vesica

int main(int argc, char** argv) {
  std::vector<int> resolutions;
  bool is_full = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--full") {
      is_full = true;
    } else {
      resolutions.push_back(std::atoi(argv[i]));
    }
  }
  if (resolutions.empty()) resolutions = {4, 6, 8};
  fmt::print("Table 1, eps = 0.3, to t = 0.45; * extrapolated from the first 100 steps\n\n");
  fmt::print("| nodes | method | steps | factorisations | seconds | CPU seconds | times IDA | ");
  fmt::print("CPU | error of F | error of lambda_V |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int resolution : resolutions)
    vesica::compare_runs(resolution, is_full || resolution == resolutions.front());
  vesica::compare_at_equal_accuracy(resolutions.front());
  return 0;
}
