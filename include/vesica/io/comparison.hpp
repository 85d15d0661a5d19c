#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "vesica/io/run_reader.hpp"
#include "vesica/io/verdict.hpp"
#include "vesica/problem/shape_distance.hpp"

namespace vesica::io {

/// One run of a comparison.
struct ComparedRun {
  std::string name;              ///< of the column and of the files: "flow", "minimize", ...
  std::filesystem::path folder;  ///< of the run
  model::Model model;
  problem::State state;  ///< the final one
  Verdict verdict;
  EnergyHistory history;
};

/// Two runs found the same equilibrium when all of these hold and the phases have the same numbers
/// of connected domains. The defaults are wide enough for two discretisations of one shape on
/// meshes of a thousand nodes, which differ by 2e-4 in energy and less in shape, and far below
/// what tells local minima apart.
struct EquilibriumTolerances {
  double energy = 1e-3;    ///< relative difference
  double shape_l2 = 1e-2;  ///< over R_c
  double phase_l2 = 5e-2;  ///< an interface of width 0.1 R_c that is 0.03 R_c off
};

/// The second run against the first.
struct Difference {
  std::string first;
  std::string second;
  double energy = 0;                   ///< second - first [energy]
  double relative_energy = 0;          ///< over the larger modulus
  problem::PerConstraint multipliers;  ///< second - first over the larger modulus
  problem::ShapeDistance shape;
  /// Both are polished minima of the discrete energy and were polished once more on the nodes of
  /// the first: all differences are those of the two minima on one mesh.
  bool is_on_common_mesh = false;
  std::optional<bool> same_equilibrium;  ///< absent unless both runs have converged
  std::string conclusion;                ///< one sentence
};

/// All runs, and all others against the first.
struct Comparison {
  std::vector<ComparedRun> runs;
  std::vector<Difference> differences;
};

/// Measures the differences. Throws ConfigError when single-phase and two-phase vesicles are mixed.
[[nodiscard]] Comparison compare(std::vector<ComparedRun> runs,
                                 const EquilibriumTolerances& tolerances = {});

/// Two finished runs: named flow and minimize when one of them is a minimisation and
/// the other is not, else first and second. Throws what `read_run` throws.
[[nodiscard]] std::vector<ComparedRun> read_runs(const std::filesystem::path& first,
                                                 const std::filesystem::path& second);

/// The JSON text of `comparison.json`; keys in docs/output.md.
[[nodiscard]] std::string to_json(const Comparison& comparison);

/// The runs side by side and what they found, for people.
void print_comparison(std::ostream& out, const Comparison& comparison);

/// Worst exit status of the runs: interrupted, numerical failure, stopped by a limit, converged.
[[nodiscard]] int exit_status(const Comparison& comparison);

}  // namespace vesica::io
