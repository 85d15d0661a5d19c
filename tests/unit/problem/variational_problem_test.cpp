#include "vesica/problem/variational_problem.hpp"

#include <gtest/gtest.h>

#include <random>

#include "equation_case.hpp"

namespace vesica::problem {
namespace {

/// The problem on a deformed sphere, with unknowns and rates of no symmetry.
struct FlowCase {
  std::string name;
  std::unique_ptr<VariationalProblem> problem;
  State start;
  Eigen::VectorXd y;
  Eigen::VectorXd y_rate;
};

FlowCase make_flow_case(std::string name, const model::Model& model) {
  std::mt19937 engine(23);
  const auto surface = deformed_sphere(engine);
  FlowCase c;
  c.name = std::move(name);
  c.problem =
      std::make_unique<VariationalProblem>(surface.triangulation, model, surface.positions, 1);
  c.start.triangulation = surface.triangulation;
  c.start.values.positions = surface.positions;
  if (model.is_two_phase)
    c.start.values.order_parameter = 0.8 * linalg::random_vector(surface.positions.rows(), engine);
  c.y = c.problem->initial_values(c.start);
  c.y += 0.02 * linalg::random_vector(c.y.size(), engine);
  c.y.tail(c.problem->num_multipliers()) =
      2 * linalg::random_vector(c.problem->num_multipliers(), engine);
  c.y_rate = linalg::random_vector(c.y.size(), engine).cwiseProduct(c.problem->differential_mask());
  return c;
}

std::vector<FlowCase> flow_cases() {
  std::vector<FlowCase> cases;
  cases.push_back(make_flow_case("two phases", two_phase_model()));
  cases.push_back(make_flow_case("two phases, material in motion", model_in_motion()));
  auto free_area = two_phase_model();
  free_area.targets.of<model::Area>().reset();
  cases.push_back(make_flow_case("two phases, area free", free_area));
  auto single = two_phase_model();
  single.is_two_phase = false;
  single.targets.of<model::PhaseDifference>().reset();
  cases.push_back(make_flow_case("one phase", single));
  return cases;
}

constexpr double time = 0.4;

Eigen::MatrixXd differences(const FlowCase& c, const EquationSettings& settings,
                            const JacobianWeights& weights) {
  constexpr double h = 1e-5;
  const auto mask = c.problem->differential_mask();
  Eigen::MatrixXd result(c.y.size(), c.y.size());
  for (Eigen::Index k = 0; k < c.y.size(); ++k) {
    Eigen::VectorXd y = c.y;
    Eigen::VectorXd rate = c.y_rate;
    const auto moved = [&](double step) {
      y[k] = c.y[k] + step * (mask[k] == 1 ? weights.value : 1);
      rate[k] = c.y_rate[k] + step * mask[k] * weights.rate;
      return c.problem->residual(settings, time, y, rate);
    };
    const Eigen::VectorXd plus = moved(h);
    result.col(k) = (plus - moved(-h)) / (2 * h);
  }
  return result;
}

TEST(VariationalJacobian, IsTheDifferenceOfTheResidualInEveryBlock) {
  for (const auto& c : flow_cases()) {
    for (const auto form : {ConstraintForm::differentiated, ConstraintForm::original}) {
      for (const JacobianWeights weights : {JacobianWeights{1, 0}, {1, 7.0}, {0, 1}}) {
        SCOPED_TRACE(fmt::format("{}, form {}, weights {} {}", c.name, static_cast<int>(form),
                                 weights.value, weights.rate));
        const EquationSettings settings{1, 30, form};
        auto matrix = c.problem->make_matrix();
        c.problem->jacobian(settings, weights, time, c.y, c.y_rate, matrix);
        const Eigen::MatrixXd jacobian = linalg::to_dense(matrix);
        const Eigen::MatrixXd expected = differences(c, settings, weights);
        const auto nodal = c.problem->num_nodal();
        const auto border = c.problem->num_multipliers();
        ASSERT_GT(expected.topLeftCorner(nodal, nodal).norm(), 1);
        const auto compare = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
          EXPECT_LE((a - b).norm(), 1e-6 * b.norm() + 1e-9);
        };
        compare(jacobian.topLeftCorner(nodal, nodal), expected.topLeftCorner(nodal, nodal));
        compare(jacobian.topRightCorner(nodal, border), expected.topRightCorner(nodal, border));
        compare(jacobian.bottomLeftCorner(border, nodal), expected.bottomLeftCorner(border, nodal));
        compare(jacobian.bottomRightCorner(border, border),
                expected.bottomRightCorner(border, border));
      }
    }
  }
}

TEST(VariationalProblem, HasTheMaterialOfTheTime) {
  const auto moving = make_flow_case("in motion", model_in_motion());
  const auto frozen = make_flow_case("frozen", with_material_at(model_in_motion(), time));
  const auto start = make_flow_case("at the start", with_material_at(model_in_motion(), 0));
  const auto residual = [&](const FlowCase& c) {
    return c.problem->residual({}, time, moving.y, moving.y_rate);
  };
  EXPECT_EQ(residual(moving), residual(frozen));
  EXPECT_GT((residual(moving) - residual(start)).norm(), 1);
  EXPECT_EQ(moving.problem->energy(time, moving.y)->total(),
            frozen.problem->energy(time, moving.y)->total());
  EXPECT_EQ(moving.problem->values(time, moving.y).mean_curvature,
            frozen.problem->values(time, moving.y).mean_curvature);
  EXPECT_GT(std::abs(moving.problem->energy(time, moving.y)->total() -
                     start.problem->energy(time, moving.y)->total()),
            1);
}

TEST(VariationalProblem, HasTheEnergyOfItsSurface) {
  const auto c = make_flow_case("two phases", two_phase_model());
  const auto& energy_problem = c.problem->energy_problem();
  const auto fields = c.problem->values(time, c.y);
  const double expected =
      energy_problem.energy(energy_problem.fields(fields.positions, fields.order_parameter, time))
          .total();
  ASSERT_GT(std::abs(expected), 1);
  EXPECT_NEAR(c.problem->energy(time, c.y)->total(), expected, 1e-12 * std::abs(expected));
}

TEST(VariationalProblem, KeepsSurfaceAndNormalVelocityWhenTheReferenceIsRenewed) {
  auto c = make_flow_case("one phase", [] {
    auto model = two_phase_model();
    model.is_two_phase = false;
    model.targets.of<model::PhaseDifference>().reset();
    return model;
  }());
  ASSERT_FALSE(c.problem->renew_coordinates(c.y, c.y_rate));
  // r = 1 + 2.5 z^2 turns the normals of the sphere by up to 48 degrees
  for (Eigen::Index i = 0; i < c.start.values.positions.rows(); ++i)
    c.y[4 * i + 3] = 2.5 * std::pow(c.start.values.positions(i, 2), 2);
  const auto before = c.problem->values(time, c.y);
  const auto velocity = c.problem->rates(c.y, c.y_rate).positions;
  const mesh::Positions normals = nodal_normals(*c.start.triangulation, before.positions);
  ASSERT_TRUE(c.problem->renew_coordinates(c.y, c.y_rate));
  const auto after = c.problem->values(time, c.y);
  EXPECT_LT((after.positions - before.positions).norm(), 1e-14);
  EXPECT_LT((after.mean_curvature - before.mean_curvature).norm(), 1e-12);
  const auto renewed = c.problem->rates(c.y, c.y_rate).positions;
  const Eigen::VectorXd normal_before = velocity.cwiseProduct(normals).rowwise().sum();
  const Eigen::VectorXd normal_after = renewed.cwiseProduct(normals).rowwise().sum();
  ASSERT_GT(normal_before.norm(), 0.1);
  EXPECT_LT((normal_after - normal_before).norm(), 1e-12);
}

}  // namespace
}  // namespace vesica::problem
