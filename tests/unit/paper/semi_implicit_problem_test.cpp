#include "vesica/paper/semi_implicit_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <array>
#include <utility>

#include "block_matrices.hpp"
#include "relaxation_cases.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::paper {
namespace {

constexpr double tau = 1e-3;
constexpr double alpha = 0.7;

/// A two-phase vesicle with everything switched on, away from equilibrium.
test::RelaxationCase rich_case() {
  auto result = test::table_1_case(1);
  auto& material = result.model.material;
  material.spontaneous_curvature = {-1, 0.5};
  material.gaussian_rigidity = {0.3, -0.2};
  auto& values = result.start.values;
  values.order_parameter *= 1.1;  // beyond 1: both parts of psi' act
  for (Eigen::Index i = 0; i < values.mean_curvature.size(); ++i)
    values.mean_curvature[i] = -2 + 0.3 * values.positions(i, 0) + 0.1 * values.positions(i, 1);
  return result;
}

struct Assembled {
  SemiImplicitProblem problem;
  SemiImplicitSystem system;
};

Assembled assemble(const test::RelaxationCase& vesicle, TangentialVelocity tangential) {
  SemiImplicitProblem problem(vesicle.start.triangulation, vesicle.model, tangential, 2);
  auto system = problem.make_system();
  const auto& values = vesicle.start.values;
  problem.assemble({tau, alpha}, values, problem.shape_operator(values.positions), system);
  return {std::move(problem), std::move(system)};
}

/// x, kappa of the start in the unknowns of the geometry block, beta = 0.
Eigen::VectorXd old_geometry(const problem::Fields& fields, int block) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(fields.positions.rows() * block);
  for (Eigen::Index i = 0; i < fields.positions.rows(); ++i) {
    y.segment<3>(i * block) = fields.positions.row(i).transpose();
    y[i * block + 3] = fields.mean_curvature[i];
  }
  return y;
}

class SemiImplicitProblemOf : public testing::TestWithParam<TangentialVelocity> {};

TEST_P(SemiImplicitProblemOf, TheMatricesAreSymmetric) {
  const auto [problem, system] = assemble(rich_case(), GetParam());
  for (const auto* matrix : {&system.geometry, &system.phase}) {
    const Eigen::MatrixXd dense = linalg::to_dense(*matrix);
    EXPECT_GT(dense.norm(), 0);
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-14 * dense.norm());
  }
}

TEST_P(SemiImplicitProblemOf, TheGeometryMatrixIsQuasiDefinite) {
  const auto [problem, system] = assemble(rich_case(), GetParam());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(linalg::to_dense(system.geometry),
                                                             Eigen::EigenvaluesOnly);
  const auto n = problem.layout().num_nodes();
  EXPECT_EQ((eigen.eigenvalues().array() > 0).count(), 3 * n);
  EXPECT_EQ((eigen.eigenvalues().array() < 0).count(), (problem.block_size() - 3) * n);
}

/// At rates zero the semi-discrete residual of (a), (b) and (d) is what a step leaves undone when
/// x, kappa and c stay as they are: both schemes have the same equations.
TEST_P(SemiImplicitProblemOf, TheOldFieldsLeaveTheResidualOfTheSemiDiscreteFlow) {
  auto vesicle = rich_case();
  vesicle.start.values.multipliers = {3.0, -2.0, 0.5};
  const auto [problem, system] = assemble(vesicle, GetParam());
  const problem::RelaxationProblem flow(vesicle.start.triangulation, vesicle.model, 1);
  const Eigen::VectorXd y = flow.layout().pack(vesicle.start.values);
  const Eigen::VectorXd residual = flow.residual({alpha, 1, problem::ConstraintForm::original}, 0,
                                                 y, Eigen::VectorXd::Zero(y.size()));
  const Eigen::Vector4d columns(-1, 3, -2, 0.5);
  const Eigen::VectorXd geometry =
      linalg::to_dense(system.geometry) * old_geometry(vesicle.start.values, problem.block_size()) +
      system.geometry_sides * columns;
  const Eigen::VectorXd phase =
      linalg::to_dense(system.phase) * vesicle.start.values.order_parameter +
      system.phase_sides * columns;
  const int block = problem.block_size();
  double largest = 0;
  for (Eigen::Index i = 0; i < problem.layout().num_nodes(); ++i) {
    largest = std::max(largest, std::abs(residual[i * 5 + 3]));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(geometry[i * block + k], residual[i * 5 + k], 1e-12);
    EXPECT_NEAR(geometry[i * block + 3] / tau, residual[i * 5 + 3], 1e-10);
    EXPECT_NEAR(phase[i] / tau, residual[i * 5 + 4], 1e-10);
    for (int k = 4; k < block; ++k) EXPECT_NEAR(geometry[i * block + k], 0, 1e-12);
  }
  EXPECT_GT(largest, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(BothVariants, SemiImplicitProblemOf,
                         testing::Values(TangentialVelocity::fields,
                                         TangentialVelocity::eliminated));

/// Displacements of a sphere along its normal, and changes of c, one a multiplier.
SemiImplicitSolution normal_displacements(const problem::Fields& fields) {
  const auto n = fields.positions.rows();
  SemiImplicitSolution solution;
  solution.geometry = Eigen::MatrixXd::Zero(4 * n, 4);
  solution.phase = Eigen::MatrixXd::Zero(n, 4);
  solution.geometry.col(0) = old_geometry(fields, 4);
  solution.phase.col(0) = fields.order_parameter;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d normal = fields.positions.row(i).transpose();
    solution.geometry.col(1).segment<3>(4 * i) = normal;
    solution.geometry.col(2).segment<3>(4 * i) = (1 + normal.x()) * normal;
    solution.geometry.col(3).segment<3>(4 * i) = (0.5 + normal.y()) * normal;
    solution.phase(i, 3) = 1 - 0.5 * normal.z();
  }
  return solution;
}

TEST(SemiImplicitProblem, TheSlopesOfTheConstraintsAreCloseToDifferences) {
  const auto sphere = test::make_sphere(8);
  auto vesicle = test::single_phase_case(sphere, 4, 12);
  vesicle.model.is_two_phase = true;
  vesicle.model.targets.of<model::PhaseDifference>() = model::Schedule(3);
  auto& values = vesicle.start.values;
  values.mean_curvature.setConstant(-2);
  values.order_parameter = 0.8 * values.positions.col(0).array() + 0.1;
  const SemiImplicitProblem problem(sphere.triangulation, vesicle.model,
                                    TangentialVelocity::eliminated, 2);
  const auto solution = normal_displacements(values);
  const auto errors_at = [&](const Eigen::Vector3d& multipliers) {
    return problem.constraint_errors(problem.fields_at(solution, multipliers), 0);
  };
  const auto slopes =
      problem.constraint_slopes(problem.fields_at(solution, Eigen::Vector3d::Zero()), solution);
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector3d shift = 1e-5 * Eigen::Vector3d::Unit(j);
    const Eigen::VectorXd difference = (errors_at(shift) - errors_at(-shift)) / 2e-5;
    EXPECT_GT(difference.cwiseAbs().minCoeff(), 0.1);
    // exact for the volume; kappa_h stands for the variation of the discrete area
    EXPECT_NEAR(slopes(0, j), difference[0], 1e-7);
    EXPECT_NEAR(slopes(1, j), difference[1], 1e-3 * difference.norm());
    EXPECT_NEAR(slopes(2, j), difference[2], 1e-3 * difference.norm());
  }
}

}  // namespace
}  // namespace vesica::paper
