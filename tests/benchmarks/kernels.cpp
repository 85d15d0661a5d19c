// Prints seconds per residual, Jacobian, factorisation, solve and recovery of Q_h on the cigar of
// Table 1, with the exponent of their growth in the number of nodes, and the cost of whole
// relaxations.
//
//   benchmark_kernels [M ...]     squares along a cube edge, N = 72 M^2 + 2; default 4 8 14
//
// Whole runs with KLU are left out above 5000 nodes: its factorisations take a minute there.

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "relaxation_cases.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/linalg/bordered_solver.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace {

using namespace vesica;
using linalg::DirectSolverKind;

struct Seconds {
  double wall = 0;
  double cpu = 0;
};

Seconds now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now().time_since_epoch();
  return {wall.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

constexpr double largest_klu_run = 5000;  // nodes

/// The smallest of a few runs, until half a second is spent.
Seconds smallest(const std::function<void()>& body) {
  Seconds best{1e300, 1e300};
  double spent = 0;
  for (int run = 0; run == 0 || (spent < 0.5 && run < 50); ++run) {
    const auto before = now();
    body();
    const auto after = now();
    best.wall = std::min(best.wall, after.wall - before.wall);
    best.cpu = std::min(best.cpu, after.cpu - before.cpu);
    spent += after.wall - before.wall;
  }
  return best;
}

/// One quantity over the meshes.
struct Row {
  std::string name;
  std::vector<Seconds> seconds;
};

/// Least-squares slope of log(seconds) over log(N).
double exponent(const std::vector<double>& nodes, const std::vector<double>& seconds) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto count = static_cast<double>(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double x = std::log(nodes[i]);
    const double y = std::log(std::max(seconds[i], 1e-9));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

void print_rows(const std::vector<Row>& rows, const std::vector<double>& nodes) {
  fmt::print("\n{:<26}", "seconds, wall (cpu)");
  for (const double n : nodes) fmt::print("{:>22}", fmt::format("N = {:.0f}", n));
  fmt::print("{:>10}\n", "exponent");
  for (const auto& row : rows) {
    std::vector<double> cpu;
    fmt::print("{:<26}", row.name);
    for (const auto& s : row.seconds) {
      cpu.push_back(s.cpu);
      fmt::print("{:>22}", fmt::format("{:.4f} ({:.4f})", s.wall, s.cpu));
    }
    fmt::print("{:>10}\n", nodes.size() > 1 ? fmt::format("{:.2f}", exponent(nodes, cpu)) : "-");
  }
}

std::vector<DirectSolverKind> kinds() {
#ifdef VESICA_WITHOUT_UMFPACK
  return {DirectSolverKind::klu};
#else
  return {DirectSolverKind::umfpack, DirectSolverKind::mumps};
#endif
}

class Table {
 public:
  void add(const std::string& name, const Seconds& seconds) {
    auto row = std::find_if(rows_.begin(), rows_.end(),
                            [&](const Row& candidate) { return candidate.name == name; });
    if (row == rows_.end()) row = rows_.insert(row, Row{name, {}});
    row->seconds.push_back(seconds);
  }
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
};

/// The kernels at a consistent state of the first steps of a run.
void time_kernels(int resolution, Table& table) {
  const auto c = test::table_1_case(resolution);
  const auto& triangulation = *c.start.triangulation;
  const fem::NodeGraph graph(triangulation);
  table.add("Q_h recovery", smallest([&] {
              (void)fem::recover_shape_operator(triangulation, graph, c.start.values.positions, 0);
            }));
  const problem::RelaxationProblem problem(c.start.triangulation, c.model, 0);
  const auto state = run::make_stepper({}, c.model, c.start)->state();
  const auto y = problem.layout().pack(state.values);
  const auto rates = problem.layout().pack(state.rates);
  const problem::EquationSettings settings;
  table.add("residual (with Q_h)",
            smallest([&] { (void)problem.residual(settings, 0, y, rates); }));
  auto matrix = problem.make_matrix();
  table.add("Jacobian", smallest([&] {
              problem.jacobian(settings, {1, 1000}, 0, y, rates, matrix);
            }));
  for (const auto kind : kinds()) {
    const std::string name(name_of(kind));
    linalg::BorderedSolver solver(kind, matrix, problem.layout().block_size());
    table.add("analysis, " + name, smallest([&] {
                linalg::BorderedSolver(kind, matrix, problem.layout().block_size());
              }));
    table.add("factorisation, " + name, smallest([&] { solver.factorise(matrix); }));
    table.add("solve, " + name, smallest([&] { (void)solver.solve(y); }));
  }
}

void print_ratios(const Table& table, std::size_t num_meshes) {
  if (kinds().size() < 2) return;
  for (const std::string part : {"analysis", "factorisation", "solve"}) {
    std::vector<double> ratios(num_meshes, 1);
    for (const auto& row : table.rows()) {
      for (std::size_t i = 0; i < num_meshes; ++i) {
        if (row.name == part + ", klu") ratios[i] *= row.seconds[i].cpu;
        if (row.name == part + ", umfpack") ratios[i] /= row.seconds[i].cpu;
      }
    }
    fmt::print("{:<26}", part + ", klu/umfpack");
    for (const double ratio : ratios) fmt::print("{:>22.2f}", ratio);
    fmt::print("\n");
  }
}

/// Runs of a scheme with a linear solver, on meshes up to `largest` nodes.
void time_runs(const std::vector<int>& resolutions, const std::vector<double>& nodes,
               solve::Scheme scheme, solve::LinearSolver kind, double largest) {
  fmt::print("\nTable 1, eps = 0.3, to the stopping rule, {}, {}\n", name_of(scheme),
             name_of(kind));
  fmt::print("{:>7}{:>7}{:>8}{:>8}{:>8}{:>6}{:>9}{:>9}{:>12}{:>12}  {}\n", "N", "steps", "newton",
             "krylov", "resid.", "fact.", "wall s", "cpu s", "F", "lambda_V", "end");
  std::vector<double> cpu;
  std::vector<double> nodes_run;
  for (std::size_t i = 0; i < resolutions.size(); ++i) {
    if (nodes[i] > largest) continue;
    solve::SolverOptions options;
    options.scheme = scheme;
    options.linear_solver = kind;
    const auto c = test::table_1_case(resolutions[i]);
    const auto before = now();
    const auto result = test::run_case(c, options);
    const auto after = now();
    cpu.push_back(after.cpu - before.cpu);
    nodes_run.push_back(nodes[i]);
    const auto& counts = result.counts();
    fmt::print(
        "{:>7.0f}{:>7}{:>8}{:>8}{:>8}{:>6}{:>9.2f}{:>9.2f}{:>12.6f}{:>12.5f}  {}\n", nodes[i],
        counts.steps, counts.newton, counts.krylov, counts.residuals, counts.factorisations,
        after.wall - before.wall, cpu.back(), result.energy(), result.volume_multiplier(),
        result.outcome.status == relax::RunStatus::converged ? "converged" : result.outcome.reason);
    std::fflush(stdout);
  }
  if (cpu.size() > 1)
    fmt::print("exponent of the CPU seconds in N: {:.2f}\n", exponent(nodes_run, cpu));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> resolutions;
  for (int i = 1; i < argc; ++i) resolutions.push_back(std::atoi(argv[i]));
  if (resolutions.empty()) resolutions = {4, 8, 14};
  if (std::any_of(resolutions.begin(), resolutions.end(), [](int m) { return m < 1; })) {
    fmt::print(stderr, "usage: benchmark_kernels [M ...]   whole numbers >= 1, N = 72 M^2 + 2\n");
    return 2;
  }
  std::vector<double> nodes;
  Table table;
  for (const int m : resolutions) {
    nodes.push_back(72.0 * m * m + 2);
    time_kernels(m, table);
  }
  print_rows(table.rows(), nodes);
  print_ratios(table, nodes.size());
  std::fflush(stdout);
  using enum solve::Scheme;
  using enum solve::LinearSolver;
  constexpr double any = std::numeric_limits<double>::infinity();
  time_runs(resolutions, nodes, paper, automatic, any);
  time_runs(resolutions, nodes, paper, klu, largest_klu_run);
  time_runs(resolutions, nodes, variational, preconditioned, any);
  return 0;
}
