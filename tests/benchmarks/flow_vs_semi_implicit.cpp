// IDA's flow against the paper's fixed-step scheme on Table 1, eps = 0.3: one run, side by side.
//
//   benchmark_flow_vs_semi_implicit [resolution ...] [--full]
//
// Resolutions (default 4 6 8) are squares along a cube edge, N = 72 m^2 + 2. The fixed-step run is
// complete on the first mesh and extrapolated from its first 100 steps on the others, unless --full
// is given. Seconds are those of the steppers; diagnostics are not counted.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fixed_step_runs.hpp"

namespace vesica {
namespace {

constexpr double end_time = 0.45;
constexpr double comparison_time = 0.05;
constexpr double paper_step = 1e-4;  // (eps/30)^2
constexpr int sampled_steps = 100;

struct Result {
  double seconds = 0;
  double steps = 0;
  double factorisations = 0;
  bool is_extrapolated = false;
  std::optional<double> energy;
  double volume_multiplier = 0;
};

/// The flow with its default tolerances and damping to the end time, and the final constraint
/// solve.
Result run_ida(const test::RelaxationCase& cigar) {
  const auto stepper = solve::make_stepper({}, cigar.model, cigar.start);
  relax::DampingController damping({}, problem::scales_of(cigar.model, cigar.start));
  relax::StopOptions stop;
  stop.normal_velocity = std::numeric_limits<double>::min();
  stop.end_time = end_time;
  const std::array<relax::Controller*, 1> controllers{&damping};
  (void)relax::relax(*stepper, cigar.model, stop, {}, controllers);
  const auto report = stepper->finish();
  const auto counts = report.counts;
  return {report.seconds.total,
          static_cast<double>(counts.steps),
          static_cast<double>(counts.factorisations),
          false,
          problem::measure(cigar.model, stepper->state()).energy.total(),
          *stepper->state().values.multipliers.volume};
}

Result run_fixed_step(const test::RelaxationCase& cigar, bool tangential_fields, bool is_complete) {
  const auto options = test::semi_implicit_options(paper_step, tangential_fields);
  const auto stepper = solve::make_stepper(options, cigar.model, cigar.start);
  relax::DampingOptions paper;
  paper.kind = relax::DampingKind::paper;
  relax::DampingController damping(paper, problem::scales_of(cigar.model, cigar.start));
  relax::StopOptions stop;
  stop.normal_velocity = std::numeric_limits<double>::min();
  stop.end_time = end_time;
  stop.max_steps = is_complete ? 10000 : sampled_steps;
  const std::array<relax::Controller*, 1> controllers{&damping};
  const auto outcome = relax::relax(*stepper, cigar.model, stop, {}, controllers);
  const double factor = is_complete ? 1 : end_time / stepper->state().time;
  const auto counts = outcome.report.counts;
  Result result{outcome.report.seconds.total * factor,
                static_cast<double>(counts.steps) * factor,
                static_cast<double>(counts.factorisations) * factor,
                !is_complete,
                {},
                *stepper->state().values.multipliers.volume};
  if (is_complete) result.energy = outcome.diagnostics.energy.total();
  return result;
}

void print_row(Eigen::Index nodes, std::string_view method, const Result& result, double ida) {
  std::string errors = "- | -";
  if (result.energy) {
    errors = fmt::format("{:+.2e} | {:+.2e}", *result.energy - test::table_1_energy,
                         result.volume_multiplier - test::table_1_volume_multiplier);
  }
  fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.1f}{} | {:.0f} | {} |\n", nodes, method,
             result.steps, result.factorisations, result.seconds,
             result.is_extrapolated ? " *" : "", result.seconds / ida, errors);
  std::fflush(stdout);
}

void compare_runs(int resolution, bool is_complete) {
  const auto cigar = test::table_1_case(resolution);
  const auto nodes = cigar.start.values.positions.rows();
  const auto ida = run_ida(cigar);
  print_row(nodes, "ida", ida, ida.seconds);
  print_row(nodes, "semi-implicit", run_fixed_step(cigar, true, is_complete), ida.seconds);
  print_row(nodes, "semi-implicit, beta eliminated", run_fixed_step(cigar, false, false),
            ida.seconds);
}

/// Energy at the comparison time with alpha = 1, and the seconds that it took.
struct Sample {
  double energy = 0;
  double seconds = 0;
};

Sample sample(const test::RelaxationCase& cigar, const solve::SolverOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto state = test::state_at(cigar, options, comparison_time, 1);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {problem::measure(cigar.model, state).energy.total(), elapsed.count()};
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
  fmt::print(
      "| method | tau | error of F in time | seconds | times IDA |\n|---|---|---|---|---|\n");
  fmt::print("| ida, rtol 1e-3 | - | {:.1e} | {:.2f} | 1 |\n", goal, normal.seconds);
  double tau = 64 * paper_step;
  Sample last;
  double error = std::numeric_limits<double>::infinity();
  for (; tau > 0.9 * paper_step; tau /= 2) {
    last = sample(cigar, test::semi_implicit_options(tau, false));
    error = std::abs(last.energy - reference);
    fmt::print("| semi-implicit | {:.1e} | {:.1e} | {:.2f} | {:.1f} |\n", tau, error, last.seconds,
               last.seconds / normal.seconds);
    std::fflush(stdout);
    if (error <= goal) return;
  }
  tau *= 2;
  const double factor = error / goal;
  fmt::print("| semi-implicit | {:.1e} | {:.1e} | {:.0f} * | {:.0f} |\n", tau / factor, goal,
             last.seconds * factor, last.seconds * factor / normal.seconds);
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
  fmt::print("| nodes | method | steps | factorisations | seconds | times IDA | error of F | ");
  fmt::print("error of lambda_V |\n|---|---|---|---|---|---|---|---|\n");
  for (const int resolution : resolutions)
    vesica::compare_runs(resolution, is_full || resolution == resolutions.front());
  vesica::compare_at_equal_accuracy(resolutions.front());
  return 0;
}
