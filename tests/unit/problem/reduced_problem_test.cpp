#include "problem/reduced_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "equation_case.hpp"
#include "vesica/problem/variational_problem.hpp"

namespace vesica::problem {
namespace {

constexpr double time = 0.4;

/// The same flow with the moment eliminated and with it among the unknowns, on a deformed sphere,
/// with unknowns and rates of no symmetry.
struct ReducedCase {
  std::string name;
  std::unique_ptr<ReducedProblem> reduced;
  std::unique_ptr<VariationalProblem> full;
  Eigen::VectorXd y;
  Eigen::VectorXd y_rate;

  /// The vector of the full problem with these unknowns and a moment, shape (N, 3).
  [[nodiscard]] Eigen::VectorXd with_moment(const Eigen::VectorXd& unknowns,
                                            const mesh::Positions& moment) const {
    const auto block = full->block_size();
    const auto n = moment.rows();
    Eigen::VectorXd result(full->size());
    for (Eigen::Index i = 0; i < n; ++i) {
      result.segment<3>(i * block) = moment.row(i).transpose();
      result[i * block + 3] = unknowns[i];
      if (block == 5) result[i * block + 4] = unknowns[n + i];
    }
    result.tail(full->num_multipliers()) = unknowns.tail(full->num_multipliers());
    return result;
  }

  /// Numbers of the unknowns of the reduced problem in the full one.
  [[nodiscard]] std::vector<Eigen::Index> places() const {
    const auto block = full->block_size();
    std::vector<Eigen::Index> result;
    for (Eigen::Index k = 3; k < block; ++k) {
      for (Eigen::Index i = 0; i < reduced->num_nodes(); ++i) result.push_back(i * block + k);
    }
    for (Eigen::Index k = full->num_nodal(); k < full->size(); ++k) result.push_back(k);
    return result;
  }
  [[nodiscard]] std::vector<Eigen::Index> moment_places() const {
    std::vector<Eigen::Index> result;
    for (Eigen::Index i = 0; i < reduced->num_nodes(); ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) result.push_back(i * full->block_size() + k);
    }
    return result;
  }
};

ReducedCase make_reduced_case(std::string name, const model::Model& model) {
  std::mt19937 engine(23);
  const auto surface = deformed_sphere(engine);
  ReducedCase c;
  c.name = std::move(name);
  c.reduced = std::make_unique<ReducedProblem>(surface.triangulation, model, surface.positions, 1);
  c.full = std::make_unique<VariationalProblem>(surface.triangulation, model, surface.positions, 1);
  State start;
  start.triangulation = surface.triangulation;
  start.values.positions = surface.positions;
  if (model.is_two_phase)
    start.values.order_parameter = 0.8 * linalg::random_vector(surface.positions.rows(), engine);
  c.y = c.reduced->initial_values(start);
  c.y += 0.02 * linalg::random_vector(c.y.size(), engine);
  c.y.tail(c.reduced->num_multipliers()) =
      2 * linalg::random_vector(c.reduced->num_multipliers(), engine);
  c.y_rate = linalg::random_vector(c.y.size(), engine).cwiseProduct(c.reduced->differential_mask());
  return c;
}

std::vector<ReducedCase> reduced_cases() {
  std::vector<ReducedCase> cases;
  cases.push_back(make_reduced_case("two phases", two_phase_model()));
  cases.push_back(make_reduced_case("two phases, material in motion", model_in_motion()));
  auto free_area = two_phase_model();
  free_area.targets.of<model::Area>().reset();
  cases.push_back(make_reduced_case("two phases, area free", free_area));
  auto single = two_phase_model();
  single.is_two_phase = false;
  single.targets.of<model::PhaseDifference>().reset();
  cases.push_back(make_reduced_case("one phase", single));
  return cases;
}

Eigen::VectorXd product(const ReducedCase& c, const EquationSettings& settings,
                        const JacobianWeights& weights, const Eigen::VectorXd& v) {
  const auto point = c.reduced->point(time, c.y);
  return c.reduced->product(point, c.reduced->linearise(settings, point, c.y_rate), weights, v);
}

TEST(ReducedProblem, HasTheResidualOfTheFullProblemAtTheMaximisingMoment) {
  for (const auto& c : reduced_cases()) {
    SCOPED_TRACE(c.name);
    const auto point = c.reduced->point(time, c.y);
    const mesh::Positions none = mesh::Positions::Zero(c.reduced->num_nodes(), 3);
    const auto full = c.full->residual({1, 30}, time, c.with_moment(c.y, point.fields.moment),
                                       c.with_moment(c.y_rate, none));
    const auto reduced = c.reduced->residual({1, 30}, time, c.y, c.y_rate);
    ASSERT_GT(reduced.norm(), 1);
    EXPECT_LE((reduced - full(c.places())).norm(), 1e-12 * reduced.norm());
    EXPECT_LE(full(c.moment_places()).norm(), 1e-8 * reduced.norm());  // the tolerance of p
    EXPECT_NEAR(c.reduced->energy(time, c.y)->total(),
                c.full->energy(time, c.with_moment(c.y, none))->total(), 1e-12 * reduced.norm());
  }
}

TEST(ReducedJacobian, IsTheDifferenceOfTheResidual) {
  constexpr double h = 1e-4;  // p is known to 1e-9
  std::mt19937 engine(5);
  for (const auto& c : reduced_cases()) {
    for (const auto form : {ConstraintForm::differentiated, ConstraintForm::original}) {
      for (const JacobianWeights weights : {JacobianWeights{1, 0}, {1, 7.0}, {0, 1}}) {
        SCOPED_TRACE(fmt::format("{}, form {}, weights {} {}", c.name, static_cast<int>(form),
                                 weights.value, weights.rate));
        const EquationSettings settings{1, 30, form};
        const Eigen::VectorXd v = linalg::random_vector(c.y.size(), engine);
        const Eigen::VectorXd mask = c.reduced->differential_mask();
        const Eigen::VectorXd change =
            (weights.value * mask + Eigen::VectorXd::Ones(v.size()) - mask).cwiseProduct(v);
        const Eigen::VectorXd rate_change = weights.rate * mask.cwiseProduct(v);
        const auto moved = [&](double step) {
          return c.reduced->residual(settings, time, c.y + step * change,
                                     c.y_rate + step * rate_change);
        };
        const Eigen::VectorXd expected = (moved(h) - moved(-h)) / (2 * h);
        ASSERT_GT(expected.norm(), 1);
        const auto m = c.reduced->num_multipliers();
        const auto exact = product(c, settings, weights, v);
        EXPECT_LE((exact - expected).norm(), 1e-5 * expected.norm());
        EXPECT_LE((exact - expected).tail(m).norm(), 1e-6 * expected.tail(m).norm() + 1e-9);
      }
    }
  }
}

TEST(ReducedJacobian, IsTheSchurComplementOfTheAssembledJacobian) {
  std::mt19937 engine(7);
  for (const auto& c : reduced_cases()) {
    SCOPED_TRACE(c.name);
    const EquationSettings settings{1, 30};
    const JacobianWeights weights{1, 7};
    const auto point = c.reduced->point(time, c.y);
    auto matrix = c.full->make_matrix();
    const mesh::Positions none = mesh::Positions::Zero(c.reduced->num_nodes(), 3);
    c.full->jacobian(settings, weights, time, c.with_moment(c.y, point.fields.moment),
                     c.with_moment(c.y_rate, none), matrix);
    const Eigen::MatrixXd full = linalg::to_dense(matrix);
    const auto x = c.places();
    const auto p = c.moment_places();
    const Eigen::MatrixXd p_of_x =
        Eigen::MatrixXd(full(p, p)).lu().solve(Eigen::MatrixXd(full(p, x)));
    const Eigen::MatrixXd coupling = full(x, p) * p_of_x;
    const Eigen::MatrixXd schur = full(x, x) - coupling;
    ASSERT_GT(coupling.norm(), 0.1 * schur.norm());
    const Eigen::VectorXd v = linalg::random_vector(c.y.size(), engine);
    const Eigen::VectorXd expected = schur * v;
    EXPECT_LE((product(c, settings, weights, v) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(ReducedProblem, KeepsTheSurfaceWhenTheReferenceIsRenewed) {
  auto c = make_reduced_case("two phases", two_phase_model());
  c.y.head(c.reduced->num_nodes()).setZero();
  ASSERT_FALSE(c.reduced->renew_coordinates(c.y, c.y_rate));
  const mesh::Positions reference = c.reduced->graph().reference;
  for (Eigen::Index i = 0; i < reference.rows(); ++i)
    c.y[i] = 2.5 * std::pow(reference(i, 2), 2);  // turns the normals by up to 48 degrees
  const auto before = c.reduced->values(time, c.y);
  ASSERT_TRUE(c.reduced->renew_coordinates(c.y, c.y_rate));
  const auto after = c.reduced->values(time, c.y);
  EXPECT_LT((after.positions - before.positions).norm(), 1e-14);
  EXPECT_LT((after.mean_curvature - before.mean_curvature).norm(), 1e-7);
  EXPECT_EQ(after.order_parameter, before.order_parameter);
}

}  // namespace
}  // namespace vesica::problem
