#pragma once

#include "vesica/compare/comparison.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::compare {

/// What a difference is measured between: a state (with its multipliers) and its energy.
struct Equilibrium {
  problem::State state;
  double energy = 0;  ///< [energy]
};

/// What two runs are compared by.
struct EquilibriumPair {
  Equilibrium first;
  Equilibrium second;
  bool is_on_common_mesh = false;
};

/// The equilibria that two runs are compared by. Polished equilibria of the discrete energy are
/// both described by the nodes of the first run and polished there once more: what the placement of
/// the nodes does to the energy, 1e-5 to 1e-3 of it, then cancels and differences are those of the
/// minima. Other runs are compared as they ended.
[[nodiscard]] EquilibriumPair on_common_mesh(const ComparedRun& first, const ComparedRun& second);

}  // namespace vesica::compare
