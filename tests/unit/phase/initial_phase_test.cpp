#include "vesica/phase/initial_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "initial_phase_fixture.hpp"
#include "surface_samples.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::phase {
namespace {

/// int h(c) as the equations see it.
double phase_difference(const mesh::Surface& surface, const Eigen::VectorXd& c) {
  const model::Model model;
  const problem::RelaxationProblem problem(surface.triangulation, model, 1);
  const Eigen::VectorXd y = problem.layout().pack(problem::state_of(surface, c).values);
  return problem.constraints(y, Eigen::VectorXd::Zero(y.size())).value[2];
}

measure::ShapeNumbers numbers_of(const mesh::Surface& surface, const Eigen::VectorXd& c) {
  return measure::shape_numbers(model::Model{}, problem::state_of(surface, c));
}

TEST(InitialPhase, OfARampIsLinearBetweenItsEnds) {
  const auto surface = problem::capsule(2);
  const auto c = initial_phase({}, surface, width, std::nullopt);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    EXPECT_NEAR(c[i], std::clamp(surface.positions(i, 0) - 1.25, -1.0, 1.0), 1e-14);
  }
  EXPECT_EQ(c.minCoeff(), -1);
  EXPECT_EQ(c.maxCoeff(), 1);
}

TEST(InitialPhase, OfARampMayRunBackwards) {
  const auto surface = problem::capsule(2);
  PhaseOptions options;
  options.from = 2.25;
  options.to = 0.25;
  const auto c = initial_phase(options, surface, width, std::nullopt);
  EXPECT_LT((c + initial_phase({}, surface, width, std::nullopt)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(InitialPhase, OfACapIsTheInterfaceProfileAtItsHeight) {
  const auto surface = problem::unit_sphere(4);
  auto options = of_kind(PhaseKind::caps);
  options.axis = Axis::z;
  options.fraction = 0.25;
  const double top = surface.positions.col(2).maxCoeff();
  const auto c = initial_phase(options, surface, width, std::nullopt);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    EXPECT_NEAR(c[i], std::tanh((surface.positions(i, 2) - 0.5 * top) / width), 1e-12);
  }
  options.ends = CapEnds::low;
  const auto low = initial_phase(options, surface, width, std::nullopt);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    EXPECT_NEAR(low[i], std::tanh((-surface.positions(i, 2) - 0.5 * top) / width), 1e-12);
  }
}

TEST(InitialPhase, OfACapMaySitInsideATorus) {
  const auto surface = problem::torus(2, 0.5, 12);
  auto options = of_kind(PhaseKind::caps);
  options.axis = Axis::radial;
  options.ends = CapEnds::low;
  options.fraction = 0.25;
  const auto c = initial_phase(options, surface, width, std::nullopt);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    const double radius = std::hypot(surface.positions(i, 0), surface.positions(i, 1));
    EXPECT_NEAR(c[i], std::tanh((1.75 - radius) / width), 1e-12);
  }
}

TEST(InitialPhase, OfTwoCapsHasTwoDomains) {
  const auto surface = problem::capsule(4);
  auto options = of_kind(PhaseKind::caps);
  options.ends = CapEnds::both;
  const auto numbers = numbers_of(surface, initial_phase(options, surface, width, std::nullopt));
  EXPECT_EQ(numbers.domains_1, 2);
  EXPECT_EQ(numbers.domains_2, 1);
  EXPECT_NEAR(*numbers.phase_fraction, 0.5, 0.02);
}

TEST(InitialPhase, OfBandsAlongTheAxisHasTheirNumber) {
  const auto surface = problem::capsule(4);
  auto options = of_kind(PhaseKind::bands);
  options.count = 3;
  const auto numbers = numbers_of(surface, initial_phase(options, surface, width, std::nullopt));
  EXPECT_EQ(numbers.domains_1, 3);
  EXPECT_EQ(numbers.domains_2, 4);
}

TEST(InitialPhase, OfBandsAroundATorusRepeatsAfterEachPeriod) {
  const auto surface = problem::torus(2, 0.5, 12);
  auto options = of_kind(PhaseKind::bands);
  options.axis = Axis::z;
  options.direction = BandDirection::around;
  options.count = 4;
  options.fraction = 0.4;
  const auto c = initial_phase(options, surface, width, std::nullopt);
  const auto numbers = numbers_of(surface, c);
  EXPECT_EQ(numbers.domains_1, 4);
  EXPECT_EQ(numbers.domains_2, 4);
  EXPECT_NEAR(*numbers.phase_fraction, 0.6, 0.01);
  auto turned = surface;  // by a quarter: x -> y -> -x
  turned.positions.col(0) = -surface.positions.col(1);
  turned.positions.col(1) = surface.positions.col(0);
  EXPECT_LT((initial_phase(options, turned, width, std::nullopt) - c).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(InitialPhase, OfBandsAroundTheAxisHasNoSeam) {
  const auto surface = problem::torus(2, 0.5, 12);
  auto options = of_kind(PhaseKind::bands);
  options.axis = Axis::z;
  options.direction = BandDirection::around;
  options.count = 3;
  const auto c = initial_phase(options, surface, 0.3, std::nullopt);
  double steepest = 0;
  for (const auto& triangle : surface.triangulation->triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = triangle[k];
      const auto b = triangle[k + 3];
      steepest =
          std::max(steepest, std::abs(c[a] - c[b]) /
                                 (surface.positions.row(a) - surface.positions.row(b)).norm());
    }
  }
  EXPECT_LT(
      steepest,
      1.3 / 0.3);  // chords are shorter than arcs, and |grad (rho phi)| is up to 1.2 on the tube
  EXPECT_GT(steepest, 0.8 / 0.3);
}

TEST(InitialPhase, OfSpotsIsPlusOneInTheDirectionsGiven) {
  const auto surface = problem::unit_sphere(5);
  const auto options = of_kind(PhaseKind::spots);
  const auto c = initial_phase(options, surface, width, std::nullopt);
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    const double angle = std::acos(
        std::clamp(std::max(surface.positions(i, 0), -surface.positions(i, 2)), -1.0, 1.0));
    EXPECT_NEAR(c[i], std::tanh((std::numbers::pi / 6 - angle) / width), 1e-5);
  }
  EXPECT_EQ(numbers_of(surface, c).domains_1, 2);
}

TEST(InitialPhase, OfNoiseStaysInItsRangeAndDependsOnTheSeedAlone) {
  const auto surface = problem::unit_sphere(3);
  auto options = of_kind(PhaseKind::noise);
  options.mean = -0.3;
  options.amplitude = 0.2;
  const auto c = initial_phase(options, surface, width, std::nullopt);
  EXPECT_GE(c.minCoeff(), -0.5);
  EXPECT_LE(c.maxCoeff(), -0.1);
  EXPECT_GT(c.maxCoeff() - c.minCoeff(), 0.35);
  EXPECT_EQ(c, initial_phase(options, surface, width, std::nullopt));
  options.seed = 2;
  EXPECT_GT((c - initial_phase(options, surface, width, std::nullopt)).norm(), 0.1);
}

TEST(InitialPhase, ThatIsUniformHasItsMean) {
  const auto surface = problem::unit_sphere(2);
  auto options = of_kind(PhaseKind::uniform);
  options.mean = 0.4;
  EXPECT_EQ(initial_phase(options, surface, width, std::nullopt),
            Eigen::VectorXd::Constant(surface.positions.rows(), 0.4));
}

TEST(InitialPhase, FromAFileIsTakenAsItStands) {
  const auto surface = problem::unit_sphere(1);
  std::string text = "# order parameter\n\n";
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    text += i % 2 == 0 ? " 1.02\t# node\r\n" : " -0.25\t# node\r\n";
  }
  const PhaseFile file(text);
  auto options = of_kind(PhaseKind::file);
  options.path = file.path();
  const auto c = initial_phase(options, surface, width, std::nullopt);
  EXPECT_EQ(c[0], 1.02);
  EXPECT_EQ(c[1], -0.25);
}

TEST(InitialPhase, FromAFileWithOneValueAVertexHasTheMeanOfTheEndsOnEdges) {
  const auto surface = problem::unit_sphere(1);
  std::string text;
  for (int i = 0; i < 12; ++i) text += std::to_string(i / 12.0) + "\n";
  const PhaseFile file(text);
  auto options = of_kind(PhaseKind::file);
  options.path = file.path();
  const auto c = initial_phase(options, surface, width, std::nullopt);
  ASSERT_EQ(c.size(), 42);
  std::set<mesh::NodeIndex> corners;
  for (const mesh::QuadraticTriangle& nodes : surface.triangulation->triangles()) {
    corners.insert({nodes[0], nodes[1], nodes[2]});
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(c[nodes[3 + i]], (c[nodes[i]] + c[nodes[(i + 1) % 3]]) / 2);
  }
  int vertex = 0;
  for (const mesh::NodeIndex node : corners) EXPECT_NEAR(c[node], vertex++ / 12.0, 1e-6);
}

TEST(InitialPhase, FromLabelsHasPhase1WhereTheLabelIs1) {
  const auto surface = problem::unit_sphere(1);
  for (const std::string other : {"0", "2"}) {
    std::string text;
    for (int i = 0; i < 42; ++i) text += i % 3 == 0 ? "1\n" : other + "\n";
    const PhaseFile file(text);
    auto options = of_kind(PhaseKind::file);
    options.path = file.path();
    const PhaseStart start = start_phase(options, surface, width, std::nullopt, {});
    for (int i = 0; i < 42; ++i) EXPECT_EQ(start.order_parameter[i], i % 3 == 0 ? 1 : -1);
    ASSERT_EQ(start.notes.size(), 1U);
    EXPECT_EQ(start.notes[0], file.path() + ": the values are the labels 1 and " + other +
                                  ": 1 becomes phase 1 (c = 1), " + other + " phase 2 (c = -1)");
  }
}

TEST(InitialPhase, OfOneValueOnlyIsNoLabel) {
  const auto surface = problem::unit_sphere(1);
  const std::vector<mesh::PointField> fields{{"c", "", Eigen::VectorXd::Zero(12)}};
  auto options = of_kind(PhaseKind::file);
  options.field = std::string("c");
  const PhaseStart start = start_phase(options, surface, width, std::nullopt, fields);
  EXPECT_EQ(start.order_parameter, Eigen::VectorXd::Zero(42));
  EXPECT_TRUE(start.notes.empty());
}

/// All kinds with a shift of the level to several targets.
class MatchedPhase : public testing::TestWithParam<PhaseKind> {};

TEST_P(MatchedPhase, MeetsItsTargetToRoundOff) {
  const auto surface = problem::capsule(3);
  auto options = of_kind(GetParam());
  for (const double target : {-8.0, 0.0, 4.71, 11.0}) {
    const auto c = initial_phase(options, surface, width, target);
    EXPECT_NEAR(phase_difference(surface, c), target, 1e-12) << "target " << target;
    EXPECT_LE(c.cwiseAbs().maxCoeff(), 1);
  }
}

TEST_P(MatchedPhase, IsNotShiftedWhenThatIsSwitchedOff) {
  const auto surface = problem::capsule(2);
  auto options = of_kind(GetParam());
  options.match_target = false;
  EXPECT_EQ(initial_phase(options, surface, width, 4.71),
            initial_phase(options, surface, width, std::nullopt));
}

TEST_P(MatchedPhase, RefusesATargetOutOfReach) {
  const auto surface = problem::capsule(2);
  const auto message = refusal(of_kind(GetParam()), surface, 14.0);
  EXPECT_NE(message.find("int h(c) = 14 is out of reach"), std::string::npos) << message;
  EXPECT_NE(message.find("-12.5"), std::string::npos) << message;
  EXPECT_NE(refusal(of_kind(GetParam()), surface, -14.0), "accepted");
}

INSTANTIATE_TEST_SUITE_P(Kinds, MatchedPhase,
                         testing::Values(PhaseKind::uniform, PhaseKind::ramp, PhaseKind::caps,
                                         PhaseKind::bands, PhaseKind::spots, PhaseKind::noise),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

TEST(MatchedPhaseTest, OfAFileOfSharpPhasesMeetsItsTarget) {
  const auto surface = problem::capsule(2);
  std::string text;
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i)
    text += surface.positions(i, 0) > 2 ? "+1\n" : "-1\n";
  const PhaseFile file(text);
  auto options = of_kind(PhaseKind::file);
  options.path = file.path();
  EXPECT_NEAR(phase_difference(surface, initial_phase(options, surface, width, 4.71)), 4.71, 1e-12);
}

TEST(MatchedPhaseTest, KeepsTheShapeOfTheInterfaceProfile) {
  const auto surface = problem::capsule(6);
  auto options = of_kind(PhaseKind::caps);
  const auto c = initial_phase(options, surface, 0.3, 4.71);
  double first = 0;
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    if (std::abs(c[i]) > 0.999) continue;
    const double interface = surface.positions(i, 0) - 0.3 * std::atanh(c[i]);
    if (first == 0) first = interface;
    EXPECT_NEAR(interface, first, 1e-10);
  }
  EXPECT_NEAR(first, 2 - 4.71 / (2 * std::numbers::pi),
              0.01);  // a capsule of radius 1/2 has area pi a length
}

}  // namespace
}  // namespace vesica::phase
