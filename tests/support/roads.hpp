#pragma once

#include <array>
#include <ostream>

#include "fixed_step_runs.hpp"

namespace vesica::test {

/// A way to solve a case; the fixed-step scheme takes a few steps, the others go to the end.
struct Road {
  const char* name;
  solve::SolverOptions options;
  long max_steps;
};

inline std::ostream& operator<<(std::ostream& out, const Road& road) { return out << road.name; }

/// With factors to round-off, so that runs of equal equations take equal steps.
inline Road weak_form() {
  Road road{"weak form", {}, 200};
  road.options.linear_solver = solve::LinearSolver::umfpack;
  return road;
}

inline Road variational_flow() {
  Road road{"variational flow", {}, 200};
  road.options.scheme = solve::Scheme::variational;
  road.options.polish = true;
  return road;
}

inline Road minimiser() {
  Road road{"minimiser", {}, 200};
  road.options.method = solve::Method::minimize;
  road.options.polish = true;
  return road;
}

inline Road papers_scheme() { return {"paper's scheme", semi_implicit_options(1e-4), 20}; }

inline std::array<Road, 4> all_roads() {
  return {weak_form(), variational_flow(), minimiser(), papers_scheme()};
}

}  // namespace vesica::test
