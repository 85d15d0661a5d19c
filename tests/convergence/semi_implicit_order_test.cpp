#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fixed_step_runs.hpp"
#include "observed_order.hpp"

namespace vesica {
namespace {

constexpr double end_time = 3e-3;
constexpr double alpha = 1;

/// Largest distance of corresponding nodes, and what else is compared.
struct Distance {
  double positions;
  double order_parameter;
  double volume_multiplier;
};

Distance distance(const problem::State& a, const problem::State& b) {
  const auto& x = a.values;
  const auto& y = b.values;
  return {(x.positions - y.positions).rowwise().norm().maxCoeff(),
          (x.order_parameter - y.order_parameter).cwiseAbs().maxCoeff(),
          std::abs(*x.multipliers.of<model::Volume>() - *y.multipliers.of<model::Volume>())};
}

/// Order 1: the second term of the error expansion still shows at these steps.
void expect_first_order(double coarse, double fine) {
  const double order = test::observed_order(coarse, fine, 2);
  EXPECT_GT(order, 0.85) << coarse << " " << fine;
  EXPECT_LT(order, 1.15) << coarse << " " << fine;
}

solve::SolverOptions accurate_ida() {
  solve::SolverOptions options;
  options.rtol = 1e-6;
  options.atol = 1e-6;
  options.final_constraint_solve = false;
  return options;
}

/// Without tangential fields the scheme discretises the equations that IDA integrates.
TEST(SemiImplicitOrder, ConvergesToTheTrajectoryOfIdaAtFirstOrder) {
  const auto cigar = test::undisturbed_cigar(2);
  const auto reference = test::state_at(cigar, accurate_ida(), end_time, alpha);
  ASSERT_EQ(reference.time, end_time);
  EXPECT_GT((reference.values.positions - cigar.start.values.positions).norm(), 0.1);
  std::vector<Distance> errors;
  for (const double tau : {1e-4, 5e-5, 2.5e-5}) {
    errors.push_back(
        distance(test::state_at(cigar, test::semi_implicit_options(tau, false), end_time, alpha),
                 reference));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    expect_first_order(errors[i - 1].positions, errors[i].positions);
    expect_first_order(errors[i - 1].order_parameter, errors[i].order_parameter);
    expect_first_order(errors[i - 1].volume_multiplier, errors[i].volume_multiplier);
  }
}

/// The fields beta damp the mesh velocity through a frame that jumps between elements, so the mesh
/// slides differently over the same shapes: the limit differs from that of IDA by a discretisation
/// error.
TEST(SemiImplicitOrder, IsOneWithTangentialFields) {
  const auto cigar = test::undisturbed_cigar(2);
  std::vector<problem::State> states;
  for (const double tau : {5e-5, 2.5e-5, 1.25e-5})
    states.push_back(test::state_at(cigar, test::semi_implicit_options(tau), end_time, alpha));
  const auto coarse = distance(states[0], states[1]);
  const auto fine = distance(states[1], states[2]);
  expect_first_order(coarse.order_parameter, fine.order_parameter);
  expect_first_order(coarse.volume_multiplier, fine.volume_multiplier);
  EXPECT_LT(fine.positions, 0.6 * coarse.positions);
  const auto ida = test::state_at(cigar, accurate_ida(), end_time, alpha);
  EXPECT_NEAR(measure::measure(cigar.model, states[2]).energy.total(),
              measure::measure(cigar.model, ida).energy.total(), 5e-3);
}

}  // namespace
}  // namespace vesica
