#pragma once

#include <Eigen/Core>
#include <string>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/solve/solver_options.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::solve {

/// An equilibrium of the discrete energy E_h (problem::EnergyProblem).
struct Equilibrium {
  problem::State state;
  model::EnergyParts energy;
  PolishReport report;
  SolverCounts counts;
  SolverSeconds seconds;
};

/// Finds an equilibrium by Newton's method on the optimality system dL = 0, C = target, gauge = 0
/// of E_h over the normal graph on `reference`, shape (N, 3), with the exact Hessian; starts from
/// the positions (taken along the normals of the reference), order parameter and multipliers of
/// `state`. Then the lowest curvature on the constraints: a negative one means a saddle, and is
/// reported with its mode. Throws RecoverableError when an element degenerates; no convergence is
/// in the report.
[[nodiscard]] Equilibrium find_equilibrium(const SolverOptions& options, const model::Model& model,
                                           const problem::State& state,
                                           const mesh::Positions& reference);

/// Returns the sentence of a step report whose polish has not converged.
[[nodiscard]] std::string no_equilibrium_text(const PolishReport& report);

/// Computes the lowest curvature of E_h at `state`, whatever method it comes from: the smallest
/// eigenvalue theta of H z = theta M z for z along the constraints, H the second derivative of E_h
/// + sum lambda_i C_i, M the metric int (v.nu)^2 + eps omega int eta^2 of the gradient flow: its
/// slowest rate of decay, or its fastest of growth [1/time].
[[nodiscard]] Curvature lowest_curvature(const SolverOptions& options, const model::Model& model,
                                         const problem::State& state);

}  // namespace vesica::solve
