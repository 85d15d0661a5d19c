#include "ida_linear_solvers.hpp"

namespace vesica::flow {

namespace {

solve::NewtonSystem& system_of(SUNLinearSolver solver) {
  return *static_cast<solve::NewtonSystem*>(solver->content);
}

int solve_system(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  try {
    sundials::view(x) = system_of(solver).solve(sundials::view(b));
    return SUNLS_SUCCESS;
  } catch (...) {
    return SUNLS_PACKAGE_FAIL_UNREC;
  }
}

}  // namespace

sundials::Matrix make_system_matrix(const sundials::Context& context) {
  sundials::Matrix matrix(sundials::not_null(SUNMatNewEmpty(context.get()), "SUNMatNewEmpty"));
  auto& operations = *matrix.get()->ops;
  operations.getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  operations.zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };
  operations.destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
  return matrix;
}

sundials::LinearSolver make_system_solver(solve::NewtonSystem& system,
                                          const sundials::Context& context) {
  sundials::LinearSolver solver(
      sundials::not_null(SUNLinSolNewEmpty(context.get()), "SUNLinSolNewEmpty"));
  solver.get()->content = &system;
  auto& operations = *solver.get()->ops;
  operations.gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  operations.setup = [](SUNLinearSolver, SUNMatrix) -> int { return SUNLS_SUCCESS; };
  operations.solve = solve_system;
  operations.free = [](SUNLinearSolver s) -> int {
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return SUNLS_SUCCESS;
  };
  return solver;
}

}  // namespace vesica::flow
