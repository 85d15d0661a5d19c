#pragma once

#include <array>

#include "vesica/io/comparison.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::io {

/// What a difference is measured between: a state (with its multipliers) and its energy.
struct Equilibrium {
  problem::State state;
  double energy = 0;  ///< [energy]
};

/// The equilibria that two runs are compared by. Runs whose discrete energies differ, or whose
/// states must not be touched, are compared as they ended.
[[nodiscard]] std::array<Equilibrium, 2> on_common_mesh(const ComparedRun& first,
                                                        const ComparedRun& second);

}  // namespace vesica::io
