#include "vesica/compare/shape_distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "observed_order.hpp"
#include "surface_samples.hpp"
#include "vesica/core/error.hpp"

namespace vesica::compare {
namespace {

RigidMotion some_motion(double angle = 2.2) {
  RigidMotion motion;
  motion.rotation =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  motion.translation = {3, -1, 2};
  return motion;
}

problem::State moved(problem::State state, const RigidMotion& motion) {
  state.values.positions = motion.of(state.values.positions);
  return state;
}

/// The same surface with its nodes and triangles in another order: no start can use the numbering.
problem::State shuffled(const problem::State& state) {
  const auto num_nodes = static_cast<std::size_t>(state.values.positions.rows());
  std::vector<mesh::NodeIndex> number(num_nodes);
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(7));
  problem::State result = state;
  for (std::size_t i = 0; i < num_nodes; ++i) {
    result.values.positions.row(number[i]) = state.values.positions.row(static_cast<int>(i));
    if (state.is_two_phase())
      result.values.order_parameter[number[i]] = state.values.order_parameter[static_cast<int>(i)];
  }
  std::vector<mesh::QuadraticTriangle> triangles(state.triangulation->triangles().begin(),
                                                 state.triangulation->triangles().end());
  for (auto& triangle : triangles)
    for (auto& node : triangle) node = number[static_cast<std::size_t>(node)];
  std::reverse(triangles.begin(), triangles.end());
  result.triangulation = std::make_shared<const mesh::Triangulation>(
      triangles, static_cast<mesh::NodeIndex>(num_nodes));
  return result;
}

Eigen::VectorXd phases(const mesh::Positions& positions, const auto& function) {
  Eigen::VectorXd c(positions.rows());
  for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = function(Eigen::Vector3d(positions.row(i)));
  return c;
}

problem::State two_phase(const mesh::Surface& surface, const auto& function) {
  return problem::state_of(surface, phases(surface.positions, function));
}

TEST(ShapeDistanceTest, OfTwoSpheresIsTheDifferenceOfTheirRadii) {
  auto larger = problem::unit_sphere(8);
  larger.positions *= 1.25;
  const auto distance =
      shape_distance(problem::state_of(larger), problem::state_of(problem::unit_sphere(8)));
  const double length = std::sqrt((1.25 * 1.25 + 1) / 2);
  EXPECT_NEAR(distance.l2, 0.25 / length, 5e-5);
  EXPECT_NEAR(distance.hausdorff, 0.25 / length, 5e-5);
  EXPECT_FALSE(distance.phase_l2);
}

TEST(ShapeDistanceTest, OfAnEllipsoidThatWasTurnedAndShiftedIsZero) {
  const problem::State start = problem::state_of(problem::ellipsoid({2, 1.2, 0.8}, 5));
  const auto motion = some_motion();
  const auto distance = shape_distance(start, moved(start, motion));
  EXPECT_LT(distance.l2, 1e-9);
  EXPECT_LT(distance.hausdorff, 1e-9);
  EXPECT_NEAR((distance.motion.rotation * motion.rotation - Eigen::Matrix3d::Identity()).norm(), 0,
              1e-9);
}

TEST(ShapeDistanceTest, DoesNotDependOnTheNumberingOfNodes) {
  const problem::State start = problem::state_of(problem::ellipsoid({2, 1.2, 0.8}, 5));
  for (const double angle : {0.3, 1.6, 3.0}) {
    const auto distance = shape_distance(start, moved(shuffled(start), some_motion(angle)));
    EXPECT_LT(distance.l2, 1e-9) << angle;
    EXPECT_LT(distance.hausdorff, 1e-9) << angle;
  }
}

TEST(ShapeDistanceTest, OfABodyOfRevolutionDoesNotStall) {
  const problem::State capsule_state = problem::state_of(problem::capsule(4));
  const auto distance =
      shape_distance(capsule_state, moved(shuffled(capsule_state), some_motion()));
  EXPECT_LT(distance.l2, 1e-3);
  EXPECT_LT(distance.hausdorff, 5e-3);
  EXPECT_LT(shape_distance(capsule_state, moved(capsule_state, some_motion())).l2, 1e-9);
}

TEST(ShapeDistanceTest, OfOneShapeOnTwoMeshesFallsAtOrderThreeOrBetter) {
  const auto distance_at = [](int resolution) {
    const problem::State first = problem::state_of(problem::ellipsoid({1.6, 1.1, 0.8}, resolution));
    const problem::State second =
        problem::state_of(problem::ellipsoid({1.6, 1.1, 0.8}, 3 * resolution / 2));
    return shape_distance(first, moved(second, some_motion())).l2;
  };
  const double coarse = distance_at(4);
  const double fine = distance_at(8);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(fine, 1e-9);  // two different surfaces
  EXPECT_GT(test::observed_order(coarse, fine, 2), 3) << coarse << " " << fine;
}

TEST(ShapeDistanceTest, ResolvesSmallDisplacementsOfTheSameMesh) {
  const problem::State start = problem::state_of(problem::ellipsoid({2, 1.2, 0.8}, 6));
  const auto distance_of = [&](double size) {
    problem::State other = start;
    for (auto row : other.values.positions.rowwise())
      row[0] += size * row[0] * row[1] * row[2];  // no rigid motion undoes it
    return shape_distance(start, moved(other, some_motion(0.4))).l2;
  };
  const double large = distance_of(1e-4);
  const double small = distance_of(1e-7);
  EXPECT_GT(large, 1e-6);
  EXPECT_NEAR(small / large, 1e-3, 1e-5) << small;
}

TEST(ShapeDistanceTest, IsTheSameFromBothSides) {
  const problem::State first = problem::state_of(problem::ellipsoid({2, 1.2, 0.8}, 4));
  const problem::State second = problem::state_of(problem::ellipsoid({1.9, 1.3, 0.8}, 5));
  const auto forth = shape_distance(first, second);
  const auto back = shape_distance(second, moved(first, some_motion()));
  EXPECT_GT(forth.l2, 0.01);
  EXPECT_NEAR(forth.l2, back.l2, 1e-8);
  EXPECT_NEAR(forth.hausdorff, back.hausdorff, 1e-6);
}

TEST(ShapeDistanceTest, PhasesDecideWhatTheShapeLeavesOpen) {
  const auto spots = [](const Eigen::Vector3d& x) {
    const Eigen::Vector3d first = Eigen::Vector3d(1, 0, 0);
    const Eigen::Vector3d second = Eigen::Vector3d(0.1, 1, 0.2).normalized();
    return std::max(std::tanh(8 * (x.dot(first) - 0.9)), std::tanh(8 * (x.dot(second) - 0.7)));
  };
  const problem::State start = two_phase(problem::unit_sphere(10), spots);
  const auto distance = shape_distance(start, moved(shuffled(start), some_motion()));
  EXPECT_LT(distance.l2, 1e-9);
  EXPECT_LT(*distance.phase_l2, 1e-8);
}

TEST(ShapeDistanceTest, OfPhasesIsTheRootOfTheMeanSquareDifference) {
  const auto surface = problem::ellipsoid({2, 1.2, 0.8}, 6);
  const problem::State first = two_phase(surface, [](const auto& x) { return x[0] / 2; });
  const problem::State second = two_phase(surface, [](const auto& x) { return x[0] / 2 + 0.125; });
  const auto distance = shape_distance(first, second);
  EXPECT_LT(distance.l2, 1e-6);
  EXPECT_NEAR(*distance.phase_l2, 0.125, 1e-6);
}

TEST(ShapeDistanceTest, ADumbbellIsNotTurnedRoundWhenItsPhasesAre) {
  const auto surface = problem::ellipsoid({2, 1, 1}, 6);
  const problem::State first =
      two_phase(surface, [](const auto& x) { return std::tanh(5 * (x[0] - 0.5)); });
  const problem::State second =
      two_phase(surface, [](const auto& x) { return -std::tanh(5 * (x[0] + 0.5)); });
  const auto distance = shape_distance(first, second);  // half a turn about y
  EXPECT_LT(distance.l2, 1e-3);
  EXPECT_LT(*distance.phase_l2, 1e-2);
}

TEST(ShapeDistanceTest, RefusesToCompareOnePhaseWithTwo) {
  const auto surface = problem::unit_sphere(2);
  const problem::State with = two_phase(surface, [](const auto& x) { return x[0]; });
  EXPECT_THROW(shape_distance(with, problem::state_of(surface)), ConfigError);
}

}  // namespace
}  // namespace vesica::compare
