#include "io/common_mesh.hpp"

namespace vesica::io {

std::array<Equilibrium, 2> on_common_mesh(const ComparedRun& first, const ComparedRun& second) {
  const auto as_it_ended = [](const ComparedRun& run) {
    return Equilibrium{run.state, run.verdict.outcome.diagnostics.energy.total()};
  };
  return {as_it_ended(first), as_it_ended(second)};
}

}  // namespace vesica::io
