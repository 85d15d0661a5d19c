#include "vesica/problem/relaxation_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "equation_case.hpp"
#include "vesica/core/error.hpp"

namespace vesica::problem {
namespace {

Eigen::VectorXd residual(const EquationCase& c, int threads = 1) {
  return c.problem(threads).residual(c.settings, c.time, c.y, c.y_rate);
}

/// Applies `change` to the three numbers at the head of every node.
template <class Change>
Eigen::VectorXd with_vectors(const EquationCase& c, Eigen::VectorXd flat, const Change& change) {
  const DofLayout layout(c.surface.triangulation->num_nodes(), c.model);
  for (Eigen::Index i = 0; i < layout.num_nodes(); ++i) {
    const Eigen::Vector3d vector = flat.segment<3>(i * layout.block_size());
    flat.segment<3>(i * layout.block_size()) = change(vector);
  }
  return flat;
}

/// Q_h comes from conjugate gradients with a relative residual of 1e-11.
constexpr double tolerance = 1e-8;

TEST(RelaxationResidual, TurnsWithTheFrameAndIgnoresItsOrigin) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(2, -1, 1).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(5, -3, 1);
  for (const auto& c : equation_cases()) {
    SCOPED_TRACE(c.name);
    auto moved = c;
    moved.y = with_vectors(
        c, c.y, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return turn * x + shift; });
    const auto turned = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return turn * v; };
    moved.y_rate = with_vectors(c, c.y_rate, turned);
    const auto here = residual(c);
    ASSERT_GT(here.norm(), 1);
    const auto expected = with_vectors(c, here, turned);
    ASSERT_GT((expected - here).norm(), 1);
    EXPECT_LT((residual(moved) - expected).norm(), tolerance * here.norm());
  }
}

/// The same surface with node i under the number new_number[i] and triangles in reverse order.
EquationCase renumbered(const EquationCase& c, const std::vector<mesh::NodeIndex>& new_number) {
  EquationCase result = c;
  const auto& old = *c.surface.triangulation;
  std::vector<mesh::QuadraticTriangle> triangles(old.triangles().begin(), old.triangles().end());
  std::reverse(triangles.begin(), triangles.end());
  for (auto& triangle : triangles) {
    for (auto& node : triangle) node = new_number[static_cast<std::size_t>(node)];
  }
  result.surface.triangulation =
      std::make_shared<const mesh::Triangulation>(std::move(triangles), old.num_nodes());
  return result;
}

Eigen::VectorXd permuted(const EquationCase& c, const Eigen::VectorXd& flat,
                         const std::vector<mesh::NodeIndex>& new_number) {
  const auto block = DofLayout(c.surface.triangulation->num_nodes(), c.model).block_size();
  Eigen::VectorXd result = flat;
  for (std::size_t i = 0; i < new_number.size(); ++i) {
    result.segment(new_number[i] * block, block) =
        flat.segment(static_cast<Eigen::Index>(i) * block, block);
  }
  return result;
}

TEST(RelaxationResidual, DoesNotDependOnTheNumbersOfNodesAndTriangles) {
  for (const auto& c : equation_cases()) {
    SCOPED_TRACE(c.name);
    std::vector<mesh::NodeIndex> new_number(
        static_cast<std::size_t>(c.surface.triangulation->num_nodes()));
    std::iota(new_number.begin(), new_number.end(), 0);
    std::shuffle(new_number.begin(), new_number.end(), std::mt19937(17));
    auto other = renumbered(c, new_number);
    other.y = permuted(c, c.y, new_number);
    other.y_rate = permuted(c, c.y_rate, new_number);
    const auto here = residual(c);
    const auto expected = permuted(c, here, new_number);
    ASSERT_GT((expected - here).norm(), 1);
    EXPECT_LT((residual(other) - expected).norm(), tolerance * here.norm());
  }
}

TEST(RelaxationProblem, HasTheMaterialOfTheTime) {
  const auto moving = make_equation_case("in motion", model_in_motion());
  const auto frozen =
      make_equation_case("frozen", with_material_at(model_in_motion(), moving.time));
  EXPECT_EQ(residual(moving), residual(frozen));
  const auto start = make_equation_case("at the start", with_material_at(model_in_motion(), 0));
  EXPECT_GT((residual(moving) - residual(start)).norm(), 1);
}

TEST(RelaxationProblem, GivesTheSameToTheLastBitOnAnyNumberOfThreads) {
  const auto c = make_equation_case("two phases", two_phase_model());
  const auto alone = c.problem(1);
  auto matrix = alone.make_matrix();
  alone.jacobian(c.settings, {1, 10}, c.time, c.y, c.y_rate, matrix);
  for (const int threads : {2, 5}) {
    const auto problem = c.problem(threads);
    EXPECT_EQ(residual(c, threads), residual(c, 1));
    auto other = problem.make_matrix();
    problem.jacobian(c.settings, {1, 10}, c.time, c.y, c.y_rate, other);
    EXPECT_EQ(other.block.values, matrix.block.values);
    EXPECT_EQ(other.columns, matrix.columns);
    EXPECT_EQ(other.rows, matrix.rows);
    EXPECT_EQ(problem.constraints(c.y, c.y_rate).rate, alone.constraints(c.y, c.y_rate).rate);
  }
}

TEST(RelaxationConstraints, ChangeAtTheirRates) {
  const auto c = make_equation_case("two phases", two_phase_model());
  const auto problem = c.problem();
  const auto exact = problem.constraints(c.y, c.y_rate);
  constexpr double h = 1e-5;
  const auto later = problem.constraints(c.y + h * c.y_rate, c.y_rate);
  const auto earlier = problem.constraints(c.y - h * c.y_rate, c.y_rate);
  for (std::size_t i = 0; i < exact.value.size(); ++i) {
    const double quotient = (later.value[i] - earlier.value[i]) / (2 * h);
    ASSERT_GT(std::abs(quotient), 1e-2);
    EXPECT_NEAR(exact.rate[i], quotient, 1e-8);
  }
}

TEST(RelaxationConstraints, EnterTheResidualWithTheirTargetsAndTheRatesOfThese) {
  auto c = make_equation_case("two phases", two_phase_model());
  const auto measured = c.problem().constraints(c.y, c.y_rate);
  const Eigen::Vector4d rows = residual(c).tail<4>();
  // at time 0.4: volume target 5 - t, phase target 1 + (t - 0.2) / 0.6
  EXPECT_NEAR(rows[0], measured.rate[0] + 1 + 30 * (measured.value[0] - 4.6), 1e-11);
  EXPECT_NEAR(rows[1], measured.rate[1] + 30 * (measured.value[1] - 14), 1e-11);
  EXPECT_NEAR(rows[2], measured.rate[2] - 1 / 0.6 + 30 * (measured.value[2] - 4.0 / 3), 1e-11);
  EXPECT_NEAR(rows[3], measured.rate[3] + 30 * (measured.value[3] + 30), 1e-11);
  c.settings.form = ConstraintForm::original;
  const Eigen::Vector4d original = residual(c).tail<4>();
  EXPECT_NEAR(original[0], measured.value[0] - 4.6, 1e-12);
  EXPECT_NEAR(original[2], measured.value[2] - 4.0 / 3, 1e-12);
}

TEST(RelaxationProblem, AsksForASmallerStepWhenAnElementHasNoArea) {
  auto c = make_equation_case("two phases", two_phase_model());
  for (const auto node : c.surface.triangulation->triangles()[3])
    c.y.segment<3>(node * 5).setZero();
  EXPECT_THROW((void)residual(c), RecoverableError);
}

TEST(RelaxationProblem, AsksForASmallerStepAndNamesTheNodeWhenAValueIsNotANumber) {
  auto c = make_equation_case("two phases", two_phase_model());
  c.y[7 * 5 + 4] = std::numeric_limits<double>::quiet_NaN();
  try {
    (void)residual(c);
    FAIL() << "nothing thrown";
  } catch (const RecoverableError& error) {
    EXPECT_NE(std::string(error.what()).find("not finite at node"), std::string::npos);
  }
}

}  // namespace
}  // namespace vesica::problem
