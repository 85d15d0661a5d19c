#include "vesica/problem/energy_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "ellipsoid_integrals.hpp"
#include "equation_case.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::problem {
namespace {

/// Fields of no symmetry on a deformed sphere, and directions for the nodes.
struct EnergyCase {
  std::string name;
  mesh::Surface surface;
  model::Model model;
  EnergyFields fields;
  EnergyRates rates;
  mesh::Positions directions;
  Multipliers multipliers{3.0, -1.5, 0.7, 0.9};

  [[nodiscard]] EnergyProblem problem() const { return {surface.triangulation, model, 1}; }
  [[nodiscard]] Eigen::Index num_nodes() const { return surface.positions.rows(); }
};

EnergyCase make_energy_case(std::string name, const model::Model& model) {
  std::mt19937 engine(5);
  EnergyCase c;
  c.name = std::move(name);
  c.surface = deformed_sphere(engine);
  c.model = model;
  const auto n = c.num_nodes();
  c.fields.positions = c.surface.positions;
  c.fields.moment = linalg::random_matrix(n, 3, engine);
  c.rates.velocity = linalg::random_matrix(n, 3, engine);
  c.directions = linalg::random_matrix(n, 3, engine);
  if (model.is_two_phase) {
    c.fields.order_parameter = 0.8 * linalg::random_vector(n, engine);
    c.rates.order_parameter = linalg::random_vector(n, engine);
  } else {
    c.multipliers[2] = 0;
  }
  return c;
}

/// All terms together, each term alone, and coefficients of other orders of magnitude.
std::vector<EnergyCase> energy_cases() {
  std::vector<EnergyCase> cases;
  const auto all = two_phase_model();
  cases.push_back(make_energy_case("all terms", all));
  auto single = all;
  single.is_two_phase = false;
  cases.push_back(make_energy_case("one phase", single));
  for (const double size : {1e-4, 1.0, 1e4}) {
    auto gaussian = all;
    gaussian.material.gaussian_rigidity = {size, -0.4 * size};
    gaussian.material.line_tension = 0;
    cases.push_back(make_energy_case(fmt::format("Gaussian {:g}", size), gaussian));
    auto line = all;
    line.material.line_tension = size;
    line.material.gaussian_rigidity = {0, 0};
    cases.push_back(make_energy_case(fmt::format("line {:g}", size), line));
    auto bending = line;
    bending.material.line_tension = 0;
    bending.material.bending_rigidity = {1.5 * size, size};
    cases.push_back(make_energy_case(fmt::format("bending {:g}", size), bending));
  }
  return cases;
}

double lagrangian(const EnergyCase& c, const EnergyFields& fields) {
  const auto problem = c.problem();
  const auto values = problem.constraints(fields.positions, fields.order_parameter).values;
  double sum = problem.energy(fields).total();
  for (std::size_t i = 0; i < values.size(); ++i) sum += c.multipliers[i] * values[i];
  return sum;
}

EnergyFields moved(EnergyFields fields, const EnergyFields& along, double factor) {
  fields.positions += factor * along.positions;
  fields.moment += factor * along.moment;
  fields.order_parameter += factor * along.order_parameter;
  return fields;
}

double dot(const EnergyFields& a, const EnergyFields& b) {
  return a.positions.cwiseProduct(b.positions).sum() + a.moment.cwiseProduct(b.moment).sum() +
         a.order_parameter.dot(b.order_parameter);
}

EnergyFields random_move(const EnergyCase& c, std::mt19937& engine, int part) {
  const auto n = c.num_nodes();
  EnergyFields move{mesh::Positions::Zero(n, 3), mesh::Positions::Zero(n, 3),
                    Eigen::VectorXd::Zero(c.fields.order_parameter.size())};
  if (part == 0) move.positions = linalg::random_matrix(n, 3, engine);
  if (part == 1) move.moment = linalg::random_matrix(n, 3, engine);
  if (part == 2) move.order_parameter = linalg::random_vector(move.order_parameter.size(), engine);
  return move;
}

TEST(EnergyProblemGradient, IsTheDifferenceOfTheLagrangianInEveryField) {
  constexpr double h = 1e-5;  // truncation about 1e-9, rounding about 1e-10 of the energy
  for (const auto& c : energy_cases()) {
    std::mt19937 engine(3);
    const auto gradient = c.problem().gradient(c.fields, c.multipliers);
    for (int part = 0; part < (c.model.is_two_phase ? 3 : 2); ++part) {
      SCOPED_TRACE(c.name + ", field " + std::to_string(part));
      const auto move = random_move(c, engine, part);
      const double expected =
          (lagrangian(c, moved(c.fields, move, h)) - lagrangian(c, moved(c.fields, move, -h))) /
          (2 * h);
      const double scale = std::max(std::abs(expected), 1e-4 * std::abs(lagrangian(c, c.fields)));
      ASSERT_GT(std::abs(expected), 1e-3);
      EXPECT_NEAR(dot(gradient, move), expected, 1e-6 * scale);
    }
  }
}

TEST(EnergyProblemGradient, OfTheReducedEnergyIsThePartialOne) {
  const auto c = make_energy_case("all terms", two_phase_model());
  const auto problem = c.problem();
  const auto reduced = [&](double h, const EnergyFields& move) {
    const auto there = moved(c.fields, move, h);
    return problem.energy(problem.fields(there.positions, there.order_parameter)).total();
  };
  std::mt19937 engine(8);
  const auto at_maximum = problem.fields(c.fields.positions, c.fields.order_parameter);
  const auto gradient = problem.gradient(at_maximum, {});
  EXPECT_LT(gradient.moment.norm(), 1e-9 * at_maximum.moment.norm());
  for (const int part : {0, 2}) {
    const auto move = random_move(c, engine, part);
    const double expected = (reduced(1e-5, move) - reduced(-1e-5, move)) / 2e-5;
    ASSERT_GT(std::abs(expected), 0.1);
    EXPECT_NEAR(dot(gradient, move), expected, 1e-6 * std::abs(expected));
  }
}

/// The gradient in the unknowns of the Hessian: p, displacement along the directions, c.
Eigen::VectorXd graph_gradient(const EnergyCase& c, const Eigen::VectorXd& y,
                               const Eigen::VectorXd& y_rate) {
  const Eigen::Index block = c.model.is_two_phase ? 5 : 4;
  EnergyFields fields = c.fields;
  EnergyRates rates = c.rates;
  for (Eigen::Index i = 0; i < c.num_nodes(); ++i) {
    fields.moment.row(i) += y.segment<3>(i * block).transpose();
    fields.positions.row(i) += y[i * block + 3] * c.directions.row(i);
    rates.velocity.row(i) += y_rate[i * block + 3] * c.directions.row(i);
    if (block == 4) continue;
    fields.order_parameter[i] += y[i * block + 4];
    rates.order_parameter[i] += y_rate[i * block + 4];
  }
  const auto g = c.problem().gradient(fields, c.multipliers, rates);
  Eigen::VectorXd result(y.size());
  for (Eigen::Index i = 0; i < c.num_nodes(); ++i) {
    result.segment<3>(i * block) = g.moment.row(i).transpose();
    result[i * block + 3] = g.positions.row(i).dot(c.directions.row(i));
    if (block == 5) result[i * block + 4] = g.order_parameter[i];
  }
  return result;
}

TEST(EnergyProblemHessian, IsTheDifferenceOfTheGradientOfTheFlow) {
  constexpr double h = 1e-5;
  for (const auto& c : energy_cases()) {
    SCOPED_TRACE(c.name);
    const int block = c.model.is_two_phase ? 5 : 4;
    const auto problem = c.problem();
    auto matrix = problem.graph().block_pattern(block);
    const JacobianWeights weights{1, 2.5};
    problem.hessian(c.fields, c.multipliers, c.rates, c.directions, weights, matrix);
    std::mt19937 engine(17);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(matrix.size);
    for (int trial = 0; trial < 5; ++trial) {
      const Eigen::VectorXd move = linalg::random_vector(matrix.size, engine);
      Eigen::VectorXd rate = 2.5 * move;  // p has no rate
      const Eigen::VectorXd expected =
          (graph_gradient(c, h * move, h * rate) - graph_gradient(c, -h * move, -h * rate)) /
          (2 * h);
      Eigen::VectorXd product(matrix.size);
      matrix.multiply({move.data(), static_cast<std::size_t>(move.size())},
                      {product.data(), static_cast<std::size_t>(product.size())});
      ASSERT_GT(expected.norm(), 1);
      EXPECT_LT((product - expected).norm(), 1e-6 * expected.norm());
    }
  }
}

TEST(EnergyProblemHessian, IsSymmetricWithoutRates) {
  for (const auto& c : energy_cases()) {
    const int block = c.model.is_two_phase ? 5 : 4;
    const auto problem = c.problem();
    auto matrix = problem.graph().block_pattern(block);
    problem.hessian(c.fields, c.multipliers, {}, c.directions, {1, 0}, matrix);
    const Eigen::MatrixXd dense = linalg::to_dense(matrix);
    ASSERT_GT(dense.norm(), 1);
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm()) << c.name;
  }
}

TEST(EnergyProblem, GivesTheEnergyOfASphereToFourthOrder) {
  model::Model model;
  model.is_two_phase = false;
  model.material.bending_rigidity = {1.3, 1.3};
  model.material.gaussian_rigidity = {0.4, 0.4};
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const auto sphere = test::make_sphere(level == 0 ? 4 : 8, 0.7);
    const EnergyProblem problem(sphere.triangulation, model, 1);
    const auto energy = problem.energy(problem.fields(sphere.positions, {}));
    EXPECT_DOUBLE_EQ(*energy.of<model::GaussianEnergy>(), 0.4 * 4 * std::numbers::pi);
    errors[level] = std::abs(*energy.of<model::BendingEnergy>() - 1.3 * 8 * std::numbers::pi);
  }
  EXPECT_GT(errors[0], 1e-9);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.5);
}

TEST(EnergyProblem, GivesTheGaussianEnergyOfAnEllipsoidToThirdOrder) {
  model::Model model;
  model.material.gaussian_rigidity = {1.5, -0.5};
  const double exact = test::exact_gaussian_energy(1, 1.6, model.material.gaussian_rigidity.at(0));
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const auto surface = test::make_ellipsoid({1, 1, 1.6}, level == 0 ? 6 : 12);
    const EnergyProblem problem(surface.triangulation, model, 1);
    const Eigen::VectorXd c = 0.5 + (0.5 / 1.6) * surface.positions.col(2).array();
    const auto energy = problem.energy({surface.positions, mesh::Positions::Zero(c.size(), 3), c});
    errors[level] = std::abs(*energy.of<model::GaussianEnergy>() - exact);
  }
  EXPECT_LT(errors[1], 1e-4 * std::abs(exact));
  EXPECT_GT(errors[0], 1e-7);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3);
}

/// Elements of a C^0 surface see most of their curvature at the edges between them.
TEST(EnergyProblem, GivesTheTotalMeanCurvatureOfAnEllipsoidToThirdOrder) {
  model::Model model;
  model.is_two_phase = false;
  model.targets.of<model::TotalMeanCurvature>() = model::Schedule(-1);
  const double exact = test::exact_mean_curvature(1, 1.6);
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const auto surface = test::make_ellipsoid({1, 1, 1.6}, level == 0 ? 6 : 12);
    const EnergyProblem problem(surface.triangulation, model, 1);
    const auto values = problem.constraints(surface.positions, {}).values;
    errors[level] =
        std::abs(values[model::place_of<model::Constraints, model::TotalMeanCurvature>] - exact);
  }
  EXPECT_LT(errors[1], 1e-4 * std::abs(exact));
  EXPECT_GT(errors[0], 1e-7);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3);
}

/// The directions from which the angles are counted change the shares of two elements of an edge,
/// not their sum.
TEST(EnergyProblem, GivesATotalMeanCurvatureThatTurnsAndMovesWithTheSurface) {
  std::mt19937 engine(5);
  const auto surface = deformed_sphere(engine);
  const auto model = two_phase_model();
  const EnergyProblem problem(surface.triangulation, model, 1);
  const Eigen::VectorXd c = Eigen::VectorXd::Zero(surface.positions.rows());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const mesh::Positions moved =
      (2 * surface.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  constexpr auto place = model::place_of<model::Constraints, model::TotalMeanCurvature>;
  const double value = problem.constraints(surface.positions, c).values[place];
  EXPECT_LT(value, -20);
  EXPECT_NEAR(problem.constraints(moved, c).values[place], 2 * value, 1e-12 * std::abs(value));
}

}  // namespace
}  // namespace vesica::problem
