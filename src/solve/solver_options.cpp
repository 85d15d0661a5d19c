#include "vesica/solve/solver_options.hpp"

#include "core/refuse.hpp"

namespace vesica::solve {

bool SolverOptions::is_preconditioned() const {
  if (linear_solver == LinearSolver::preconditioned) return true;
  return linear_solver == LinearSolver::automatic && method == Method::ida &&
         scheme == Scheme::variational && newton == NewtonMode::krylov;
}

linalg::DirectSolverKind SolverOptions::direct_solver() const {
  switch (linear_solver) {
    case LinearSolver::umfpack:
      return linalg::DirectSolverKind::umfpack;
    case LinearSolver::klu:
      return linalg::DirectSolverKind::klu;
    case LinearSolver::mumps:
      return linalg::DirectSolverKind::mumps;
    default:
      return linalg::default_direct_solver;
  }
}

linalg::DirectSolverKind SolverOptions::flow_solver() const {
  const bool is_chosen = linear_solver != LinearSolver::automatic || newton == NewtonMode::direct;
  return is_chosen ? direct_solver() : linalg::default_preconditioner;
}

void SolverOptions::check_together() const {
  if (initial_step > max_step) {
    refuse("solver.initial_step", initial_step,
           fmt::format("must be <= solver.max_step = {}", max_step));
  }
  if (linear_solver == LinearSolver::preconditioned) {
    if (method != Method::ida || scheme != Scheme::variational) {
      refuse("solver.linear_solver", "preconditioned",
             "must be auto, umfpack, klu or mumps but for solver.method = ida with solver.scheme = "
             "variational");
    }
    if (newton == NewtonMode::direct) {
      refuse("solver.linear_solver", "preconditioned",
             "must be auto, umfpack, klu or mumps for solver.newton = direct");
    }
  }
  if (method != Method::semi_implicit) return;
  if (scheme == Scheme::variational)
    refuse("solver.scheme", "variational", "must be paper for solver.method = semi-implicit");
  if (polish) refuse("solver.polish", true, "must be false for solver.method = semi-implicit");
}

}  // namespace vesica::solve
