#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "block_matrices.hpp"
#include "minimise/augmented_energy.hpp"
#include "minimise/tangent_newton.hpp"
#include "vesica/core/error.hpp"

namespace vesica::minimise {
namespace {

using linalg::random_vector;

constexpr double pi = std::numbers::pi;

/// Every constant differs between the phases.
model::Model two_phase_model() {
  model::Model model;
  model.material.bending_rigidity = {1.5, 0.9};
  model.material.spontaneous_curvature = {-1, 0.5};
  model.material.gaussian_rigidity = {0.7, -0.4};
  model.material.line_tension = 1.2;
  model.material.interface_width = 0.4;
  model.targets = {model::Schedule(5), model::Schedule(14), model::Schedule(1)};
  return model;
}

/// Metric and coordinates on an ellipsoid with 162 nodes and a smooth phase field.
class MinimiserVariables : public ::testing::Test {
 protected:
  [[nodiscard]] Eigen::MatrixXd constraint_slopes() const {
    Eigen::MatrixXd columns = constraints_.gradients(graph_, start_.sample.constraints, true);
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      columns.col(k) = coordinates_.slope(columns.col(k));
    return columns;
  }
  [[nodiscard]] GraphPoint make_start() const {
    GraphPoint point;
    point.unknowns.setZero(2 * order_parameter_.size());
    point.unknowns.tail(order_parameter_.size()) = order_parameter_;
    point.sample = sample_energy(problem_, surface_.positions, order_parameter_);
    return point;
  }
  [[nodiscard]] InnerProblem inner_problem(const MinimiserCoordinates& coordinates) const {
    return {problem_,
            graph_,
            constraints_,
            coordinates,
            Eigen::Vector3d(3, -2, 1),
            Eigen::Vector3d(30, 20, 10),
            0.5,
            2.0};
  }

  std::mt19937 engine_{6};
  mesh::Surface surface_ = test::make_ellipsoid({1.5, 1, 0.8}, 2);
  Eigen::VectorXd order_parameter_ = (surface_.positions.col(0) / 1.5).array().tanh();
  model::Model model_ = two_phase_model();
  problem::Scales scales_{1.1, 1.5};
  problem::EnergyProblem problem_{surface_.triangulation, model_, 1};
  ConstraintSet constraints_{model_, scales_};
  problem::NormalGraph graph_ =
      problem::make_normal_graph(*surface_.triangulation, surface_.positions);
  EnergyMetric metric_{problem_, scales_};
  MinimiserCoordinates coordinates_ = [this] {
    metric_.factorise(surface_.positions, order_parameter_);
    return MinimiserCoordinates(metric_, graph_);
  }();
  GraphPoint start_ = make_start();
};

TEST_F(MinimiserVariables, GradientIsTheDerivativeOfTheValue) {
  coordinates_.absorb(constraint_slopes(), Eigen::Vector3d(30, 20, 10), 0.7);
  const auto inner = inner_problem(coordinates_);
  AugmentedEnergy energy(inner, start_);
  const auto n = coordinates_.size();
  const Eigen::VectorXd y = 0.02 * random_vector(n, engine_);
  Eigen::VectorXd gradient(n);
  double value = 0;
  ASSERT_TRUE(energy.evaluate(y, value, gradient.data()));
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd direction = random_vector(n, engine_);
    constexpr double step = 1e-4;
    double ahead = 0;
    double behind = 0;
    ASSERT_TRUE(energy.evaluate(y + step * direction, ahead, nullptr));
    ASSERT_TRUE(energy.evaluate(y - step * direction, behind, nullptr));
    const double slope = gradient.dot(direction);
    EXPECT_GT(std::abs(slope), 1e-2 * gradient.norm());
    EXPECT_NEAR((ahead - behind) / (2 * step), slope, 1e-6 * gradient.norm() * direction.norm());
  }
}

TEST_F(MinimiserVariables, ValueIsTheAugmentedLagrangianInTheEnergyUnit) {
  const auto inner = inner_problem(coordinates_);
  const AugmentedEnergy energy(inner, start_);
  const auto& c = start_.sample.constraints.values;
  const double v = c[0] - 5;
  const double a = c[1] - 14;
  const double h = c[2] - 1;
  const double expected = start_.sample.energy.total() + 3 * v - 2 * a + h +
                          0.5 * (30 * v * v + 20 * a * a + 10 * h * h);
  EXPECT_NEAR(energy.value(start_.sample), expected / 2.0, 1e-12 * std::abs(expected));
}

TEST_F(MinimiserVariables, PointsTooFarAwayAreRefusedAndTheLastGoodOneStays) {
  const auto inner = inner_problem(coordinates_);
  AugmentedEnergy energy(inner, start_);
  double value = 0;
  EXPECT_FALSE(energy.evaluate(1e3 * random_vector(coordinates_.size(), engine_), value, nullptr));
  EXPECT_EQ(energy.refusals(), 1);
  EXPECT_EQ(energy.evaluations(), 0);
  EXPECT_EQ(energy.last().unknowns, start_.unknowns);
}

TEST_F(MinimiserVariables, PullBackIsTheAdjointOfTheChange) {
  coordinates_.absorb(constraint_slopes(), Eigen::Vector3d(1e4, 1e3, 1e2), 0.5);
  const auto y = random_vector(coordinates_.size(), engine_);
  const auto g = random_vector(coordinates_.size(), engine_);
  const Eigen::VectorXd change = coordinates_.change(y);
  EXPECT_GT(change.norm(), 0.1);
  EXPECT_NEAR(g.dot(change), coordinates_.pull_back(g).dot(y), 1e-12 * g.norm() * change.norm());
}

TEST_F(MinimiserVariables, NoChangeMovesTheSurfaceAsARigidBody) {
  const auto y = random_vector(coordinates_.size(), engine_);
  const Eigen::VectorXd displacements = coordinates_.change(y).head(graph_.reference.rows());
  const Eigen::VectorXd rigid = graph_.gauge.transpose() * displacements;
  EXPECT_GT(graph_.gauge.colwise().norm().minCoeff(), 0);  // three different axes: six motions
  EXPECT_LT(rigid.norm(), 1e-12 * displacements.norm());
}

TEST_F(MinimiserVariables, ThePenaltyHasNoLargeCurvatureInAnyDirection) {
  const Eigen::MatrixXd slopes = constraint_slopes();
  const Eigen::Vector3d weights(1e4, 1e4, 1e4);
  coordinates_.absorb(slopes, weights, 1);
  Eigen::MatrixXd columns = constraints_.gradients(graph_, start_.sample.constraints, true);
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    columns.col(k) = 1e2 * coordinates_.pull_back(columns.col(k));
  EXPECT_GT((1e2 * slopes).colwise().norm().minCoeff(), 10);  // it has without the scaling
  EXPECT_LT((columns.transpose() * columns).eigenvalues().cwiseAbs().maxCoeff(), 1 + 1e-9);
}

TEST_F(MinimiserVariables, RefusesATargetThatChangesInTime) {
  auto ramped = model_;
  ramped.targets.of<model::Volume>() = model::Schedule::ramp(5, 4, 0, 1);
  try {
    const ConstraintSet constraints(ramped, scales_);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "constraints.volume = [5, 4, 0, 1]: must be constant for solver.method = minimize");
  }
}

TEST(Slopes, MultipliersMakeTheGradientOrthogonalToTheConstraints) {
  std::mt19937 engine(3);
  Slopes slopes{random_vector(50, engine), linalg::random_matrix(50, 3, engine)};
  slopes.constraints.col(1) *= 1e5;  // the units of the constraints differ
  const Eigen::VectorXd rest = slopes.energy + slopes.constraints * slopes.multipliers();
  EXPECT_GT(rest.norm(), 0.1);
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_LT(std::abs(rest.dot(slopes.constraints.col(k))),
              1e-12 * slopes.constraints.col(k).norm());
}

TEST(Slopes, DependentConstraintsShareOneMultiplierOfModerateSize) {
  std::mt19937 engine(3);
  Slopes slopes{random_vector(50, engine), linalg::random_matrix(50, 2, engine)};
  slopes.constraints.col(1) = slopes.constraints.col(0) + 1e-9 * slopes.constraints.col(1);
  EXPECT_LT(slopes.multipliers().norm(), 10);
}

TEST(Slopes, ChangeCorrectsTheConstraintsToFirstOrder) {
  std::mt19937 engine(3);
  const Slopes slopes{random_vector(50, engine), linalg::random_matrix(50, 3, engine)};
  const Eigen::Vector3d errors(1, -2, 3);
  EXPECT_LT((slopes.constraints.transpose() * slopes.change_for(errors) - errors).norm(), 1e-12);
}

/// With S = 2 sqrt(k)/R^2 M on constants, the derivative M 1 has the squared length R^4/(4 k) times
/// the area.
TEST(EnergyMetric, MeasuresTheExpansionOfASphereLikeTheContinuousOperator) {
  model::Model model;
  model.is_two_phase = false;
  model.material.bending_rigidity = {2.5, 2.5};
  const double radius = 1.3;
  const auto sphere = test::make_sphere(4, radius);
  const problem::EnergyProblem problem(sphere.triangulation, model, 1);
  EnergyMetric metric(problem, {radius, 2.5});
  metric.factorise(sphere.positions, {});
  const auto graph = problem::make_normal_graph(*sphere.triangulation, sphere.positions);
  const auto constraints = problem.constraints(sphere.positions, {});
  const Eigen::VectorXd derivative = along_graph(graph, constraints.positions[0], {}, false);
  const double expected = std::pow(radius, 4) / (4 * 2.5) * 4 * pi * radius * radius;
  EXPECT_NEAR(metric.gather(derivative).squaredNorm(), expected, 1e-3 * expected);
  const Eigen::VectorXd velocity = metric.l2_gradient(derivative);
  EXPECT_NEAR(derivative.dot(velocity) / derivative.sum(), 1, 1e-3);
  EXPECT_LT((velocity.array() - 1).abs().maxCoeff(), 0.1);  // noise of the nodal normals
}

TEST(EnergyMetric, SpreadIsTheAdjointOfGather) {
  std::mt19937 engine(8);
  const auto sphere = test::make_sphere(2);
  const problem::EnergyProblem problem(sphere.triangulation, two_phase_model(), 1);
  EnergyMetric metric(problem, {1, 1});
  metric.factorise(sphere.positions, 0.5 * sphere.positions.col(2));
  const auto z = random_vector(metric.size(), engine);
  const auto g = random_vector(metric.size(), engine);
  const Eigen::VectorXd u = metric.spread(z);
  EXPECT_NEAR(u.dot(g), metric.gather(g).dot(z), 1e-12 * u.norm() * g.norm());
}

TEST_F(MinimiserVariables, SecondDerivativeIsThatOfTheReducedLagrangian) {
  const Eigen::Vector3d multipliers(3, -2, 1);
  const ReducedHessian hessian(problem_, start_.sample.fields, constraints_.all(multipliers),
                               graph_, 1);
  const Eigen::VectorXd u = random_vector(metric_.size(), engine_);
  const auto gradient_at = [&](double step) {
    const Eigen::VectorXd there = start_.unknowns + step * u;
    const auto sample =
        sample_energy(problem_, positions_of(graph_, there), order_parameter_of(graph_, there));
    return constraints_.lagrangian_gradient(graph_, sample, multipliers, true);
  };
  const double step = 1e-5;
  const Eigen::VectorXd difference = (gradient_at(step) - gradient_at(-step)) / (2 * step);
  const Eigen::VectorXd product = hessian.times(u);
  const auto n = graph_.reference.rows();
  ASSERT_GT(product.head(n).norm(), 1);
  ASSERT_GT(product.tail(n).norm(), 1);
  EXPECT_LT((product - difference).head(n).norm(), 1e-6 * product.head(n).norm());
  EXPECT_LT((product - difference).tail(n).norm(), 1e-6 * product.tail(n).norm());
}

TEST_F(MinimiserVariables, LowestEigenvalueIsThatOfTheDenseMatrixOnTheTangentSpace) {
  const Eigen::Vector3d multipliers(3, -2, 1);
  const Slopes slopes{Eigen::VectorXd::Zero(metric_.size()), constraint_slopes()};
  const ReducedHessian hessian(problem_, start_.sample.fields, constraints_.all(multipliers),
                               graph_, 1);
  const TangentHessian tangent(hessian, coordinates_, slopes);
  Eigen::MatrixXd dense(metric_.size(), metric_.size());
  const Eigen::MatrixXd basis = orthonormal_basis(slopes.constraints);
  for (Eigen::Index k = 0; k < dense.cols(); ++k) {
    Eigen::VectorXd z = coordinates_.without_rigid(Eigen::VectorXd::Unit(dense.cols(), k));
    z -= basis * (basis.transpose() * z);
    dense.col(k) = coordinates_.slope(hessian.times(coordinates_.spread(z)));
    dense.col(k) -= basis * (basis.transpose() * dense.col(k));
  }
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-10 * dense.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense);
  ASSERT_LT(eigen.eigenvalues()[0], -0.1);
  const auto lowest = tangent.lowest();
  EXPECT_NEAR(lowest.value, eigen.eigenvalues()[0], 1e-2 * std::abs(lowest.value));
  EXPECT_NEAR(lowest.vector.dot(dense * lowest.vector), lowest.value, 1e-8);
}

}  // namespace
}  // namespace vesica::minimise
