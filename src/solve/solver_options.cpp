#include "vesica/solve/solver_options.hpp"

#include "core/refuse.hpp"

namespace vesica::solve {

void SolverOptions::check_together() const {
  if (initial_step > max_step) {
    refuse("solver.initial_step", initial_step,
           fmt::format("must be <= solver.max_step = {}", max_step));
  }
  if (method != Method::semi_implicit) return;
  if (scheme == Scheme::variational)
    refuse("solver.scheme", "variational", "must be paper for solver.method = semi-implicit");
  if (polish) refuse("solver.polish", true, "must be false for solver.method = semi-implicit");
}

}  // namespace vesica::solve
