#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "vesica/fem/recovery.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/redistribute.hpp"
#include "vesica/problem/normal_graph.hpp"
#include "vesica/run/run.hpp"

namespace vesica::run {
namespace {

const Options without_files{.writes_files = false};

config::RunConfig prolate(int resolution) {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::ellipsoid;
  config.shape.semi_axes = {1.4, 1, 1};
  config.shape.resolution = resolution;
  return config;
}

/// The case with its nodes displaced along the normals by noise of this part of an edge.
setup::Case noisy(const config::RunConfig& config, double noise) {
  setup::Case vesicle = setup::make_case(config);
  auto& positions = vesicle.start.values.positions;
  const auto graph = problem::make_normal_graph(*vesicle.start.triangulation, positions);
  const double edge = 1.0 / config.shape.resolution;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    positions.row(i) += noise * edge * uniform(engine) * graph.directions.row(i);
  return vesicle;
}

/// Whether one of the events says so.
bool tells(const Result& result, const std::string& text) {
  const auto& events = result.verdict.outcome.events;
  return std::any_of(events.begin(), events.end(), [&text](const relax::Event& event) {
    return event.what.find(text) != std::string::npos;
  });
}

class RoughStart : public ::testing::TestWithParam<double> {};

TEST_P(RoughStart, IsMadeSmoothForTheFlowUnlessTheCaseForbidsIt) {
  config::RunConfig config = prolate(4);
  config.solver.method = solve::Method::ida;
  config.constraints.reduced_volume = 0.9;
  const setup::Case vesicle = noisy(config, GetParam());
  const Result result = run(config, vesicle, without_files);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::converged)
      << result.verdict.outcome.reason;
  EXPECT_TRUE(tells(result, "the start was too rough"));
  config.solver.mend_start = false;
  const Result refused = run(config, vesicle, without_files);
  EXPECT_EQ(refused.verdict.outcome.status, relax::RunStatus::numerical_failure);
}

INSTANTIATE_TEST_SUITE_P(Noise, RoughStart, ::testing::Values(0.1, 0.3));

/// The size field of a rough surface would follow the noise.
TEST(RoughStart, IsMadeSmoothBeforeItsMeshIsAdapted) {
  config::RunConfig config = prolate(4);
  config.constraints.reduced_volume = 0.9;
  config.adaption.enabled = true;
  const Result result = run(config, noisy(config, 0.4), without_files);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::converged)
      << result.verdict.outcome.reason;
  const Result smooth = run(config, without_files);
  EXPECT_NEAR(static_cast<double>(result.verdict.num_nodes) / smooth.verdict.num_nodes, 1, 0.1);
  EXPECT_NEAR(result.verdict.outcome.diagnostics.energy.total() /
                  smooth.verdict.outcome.diagnostics.energy.total(),
              1, 1e-5);
  EXPECT_TRUE(tells(result, "the start was too rough"));
}

/// The prolate of v = 0.8 is the shape of least energy there.
TEST(FarStart, OfASphereEndsAsTheProlate) {
  config::RunConfig config;
  config.shape.kind = shapes::ShapeKind::sphere;
  config.shape.resolution = 4;
  config.constraints.reduced_volume = 0.8;
  const Result sphere = run(config, without_files);
  ASSERT_EQ(sphere.verdict.outcome.status, relax::RunStatus::converged)
      << sphere.verdict.outcome.reason;
  EXPECT_TRUE(tells(sphere, "off its targets"));
  config::RunConfig direct = prolate(4);
  direct.shape.semi_axes = {1.9, 0.9, 0.9};
  direct.constraints.reduced_volume = 0.8;
  const Result expected = run(direct, without_files);
  EXPECT_NEAR(sphere.verdict.outcome.diagnostics.energy.total() /
                  expected.verdict.outcome.diagnostics.energy.total(),
              1, 2e-3);
}

/// The rim of the start is thinner than an element. The oblate of v = 0.6 has 49.157.
TEST(FarStart, OfAThinDiscEndsAsTheOblate) {
  config::RunConfig config = prolate(6);
  config.shape.semi_axes = {1, 1, 0.1};
  config.constraints.reduced_volume = 0.6;
  const Result result = run(config, without_files);
  EXPECT_EQ(result.verdict.outcome.status, relax::RunStatus::converged)
      << result.verdict.outcome.reason;
  EXPECT_NEAR(result.verdict.outcome.diagnostics.energy.total(), 49.157, 0.05);
}

TEST(FarStart, IsLeftAsItIsWhereTheCaseSaysSo) {
  config::RunConfig config = prolate(3);
  config.solver.mend_start = false;
  config.constraints.reduced_volume = 0.85;
  const Result result = run(config, without_files);
  EXPECT_FALSE(tells(result, "off its targets"));
}

}  // namespace
}  // namespace vesica::run
