#include "vesica/measure/profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface_samples.hpp"

namespace vesica::measure {
namespace {

TEST(ProfileTest, OfAnEllipsoidIsTheEllipseOfItsTwoLongerAxes) {
  problem::State state = problem::state_of(problem::ellipsoid({1, 2, 0.6}, 6));
  state.values.positions.rowwise() += Eigen::RowVector3d(3, -1, 2);
  const auto plane = profile_plane(state);
  EXPECT_NEAR(std::abs(plane.along.y()), 1, 1e-6);
  EXPECT_NEAR(std::abs(plane.across.x()), 1, 1e-6);
  const auto loops = profile(state, plane);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_GT(loops[0].size(), 40U);
  EXPECT_EQ(loops[0].front().along, loops[0].back().along);
  EXPECT_EQ(loops[0].front().across, loops[0].back().across);
  double winding = 0;
  for (std::size_t i = 0; i < loops[0].size(); ++i) {
    const auto& point = loops[0][i];
    EXPECT_NEAR(std::hypot(point.along / 2, point.across), 1, 1e-3);
    if (i == 0) continue;
    const auto& last = loops[0][i - 1];
    winding += (last.along * point.across - last.across * point.along) / 2;
  }
  EXPECT_NEAR(std::abs(winding), 2 * std::numbers::pi,
              0.02 * 2 * std::numbers::pi);  // once around, in order
}

TEST(ProfileTest, OfATorusThroughItsAxisAreTwoCircles) {
  const problem::State state = problem::state_of(problem::torus(1, 0.3, 8));
  const auto loops = profile(state, {Eigen::Vector3d::Zero(), {1, 0, 0}, {0, 0, 1}});
  ASSERT_EQ(loops.size(), 2U);
  for (const auto& loop : loops) {
    const double centre = loop.front().along > 0 ? 1 : -1;
    for (const auto& point : loop)
      EXPECT_NEAR(std::hypot(point.along - centre, point.across), 0.3, 1e-3);
  }
}

TEST(ProfileTest, HasAPointWherePhasesMeet) {
  const auto surface = problem::ellipsoid({2, 1, 0.8}, 5);
  const Eigen::VectorXd c = surface.positions.col(0).array() - 0.3;
  const problem::State state = problem::state_of(surface, c);
  const auto loops = profile(state, profile_plane(state));
  ASSERT_EQ(loops.size(), 1U);
  const auto is_interface = [](const ProfilePoint& point) { return point.order_parameter == 0; };
  EXPECT_EQ(std::count_if(loops[0].begin(), loops[0].end(), is_interface), 2);
  for (const auto& point : loops[0]) {
    if (!is_interface(point)) continue;
    EXPECT_NEAR(std::abs(point.along), 0.3, 1e-3);
  }
}

TEST(ProfileTest, IsEmptyWhereThePlaneMissesTheSurface) {
  EXPECT_TRUE(profile(problem::state_of(problem::unit_sphere(2)), {{0, 0, 5}, {1, 0, 0}, {0, 1, 0}})
                  .empty());
}

}  // namespace
}  // namespace vesica::measure
