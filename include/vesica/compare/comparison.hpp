#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vesica/compare/shape_distance.hpp"
#include "vesica/model/model.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::compare {

/// The energy in the course of a run, one value a step, the start included. The single energy of a
/// run whose initial values could not be made consistent is NaN.
struct EnergyHistory {
  std::vector<double> step;
  std::vector<double> seconds;  ///< wall clock, since the start of the run
  std::vector<double> energy;   ///< total [energy]
};

/// One run of a comparison.
struct ComparedRun {
  std::string name;              ///< of the column and of the files: "flow", "minimize", ...
  std::filesystem::path folder;  ///< of the run
  model::Model model;
  problem::State state;  ///< the final one
  relax::Verdict verdict;
  EnergyHistory history;
};

/// Tolerances within which two runs count as the same equilibrium. Two runs found the same
/// equilibrium when all of these hold and the phases have the same numbers of connected domains.
/// The defaults are wide enough for two discretisations of one shape on meshes of a thousand nodes,
/// which differ by 2e-4 in energy and less in shape, and far below what tells local minima apart.
struct EquilibriumTolerances {
  double energy = 1e-3;    ///< relative difference
  double shape_l2 = 1e-2;  ///< over R_c
  double phase_l2 = 5e-2;  ///< an interface of width 0.1 R_c that is 0.03 R_c off
};

/// The differences of a second run from the first.
struct Difference {
  std::string first;
  std::string second;
  double energy = 0;                 ///< second - first [energy]
  double relative_energy = 0;        ///< over the larger modulus
  model::PerConstraint multipliers;  ///< second - first over the larger modulus
  ShapeDistance shape;
  /// Whether both are polished minima of the discrete energy and were polished once more on the
  /// nodes of the first: all differences are those of the two minima on one mesh.
  bool is_on_common_mesh = false;
  std::optional<bool> same_equilibrium;  ///< absent unless both runs have converged
  std::string conclusion;                ///< one sentence

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"energy/absolute", "energy", "second - first"}, self.energy);
    visit(Field{"energy/relative", "-", "over the larger modulus"}, self.relative_energy);
    visit(Field{"multipliers", "-", "over the larger modulus"}, self.multipliers);
    visit(Field{"", "-", "distances of the shapes"}, self.shape);
    visit(Field{"on_common_mesh", "-", "both polished on one mesh"}, self.is_on_common_mesh);
    visit(Field{"same_equilibrium", "-", "absent: not known"}, self.same_equilibrium);
    visit(Field{"conclusion", "-", "one sentence"}, self.conclusion);
  }
};

/// A comparison: all runs, and the differences of all others from the first.
struct Comparison {
  std::vector<ComparedRun> runs;
  std::vector<Difference> differences;
};

/// Measures the differences of all other runs from the first. Throws ConfigError when single-phase
/// and two-phase vesicles are mixed.
[[nodiscard]] Comparison compare(std::vector<ComparedRun> runs,
                                 const EquilibriumTolerances& tolerances = {});

/// Returns the worst exit status of the runs, in this order: interrupted, numerical failure,
/// stopped by a limit, converged.
[[nodiscard]] int exit_status(const Comparison& comparison);

}  // namespace vesica::compare
