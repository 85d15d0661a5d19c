#include "vesica/relax/self_intersection_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "vesica/shapes/shapes.hpp"

namespace vesica::relax {
namespace {

/// A unit sphere whose north pole is pushed down, through the south from a depth of 2 on.
class SelfIntersectionControllerTest : public ::testing::Test {
 protected:
  using Response = std::vector<Request> (Controller::*)(const StepView& view);

  std::string answer(Controller& controller, long step, double depth,
                     Response response = &Controller::respond) {
    shapes::ShapeOptions options;
    options.kind = shapes::ShapeKind::sphere;
    options.resolution = 12;
    const mesh::Surface sphere = shapes::make_shape(options);
    problem::State state;
    state.triangulation = sphere.triangulation;
    state.values.positions = sphere.positions;
    for (auto row : state.values.positions.rowwise())
      if (row[2] > 0) row[2] -= depth * std::exp(-row.head<2>().squaredNorm() / 0.16);
    solve::StepReport report;
    report.counts.steps = step;
    const measure::Diagnostics measured;
    const auto requests = (controller.*response)({state, report, measured});
    if (requests.empty()) return "nothing";
    const auto& stop = std::get<Stop>(requests.front());
    EXPECT_EQ(stop.status, RunStatus::self_intersection);
    return stop.reason;
  }
};

TEST_F(SelfIntersectionControllerTest, EndsTheRunAtAFrameAndTellsWhere) {
  SelfIntersectionController controller(5);
  EXPECT_EQ(answer(controller, 0, 1.5), "nothing");
  EXPECT_EQ(answer(controller, 5, 1.9), "nothing");
  EXPECT_EQ(answer(controller, 7, 2.3), "nothing");
  const std::string reason = answer(controller, 10, 2.3);
  EXPECT_TRUE(reason.starts_with("the surface cuts itself after step 10, triangles ")) << reason;
  EXPECT_TRUE(reason.ends_with("); free of it after step 5")) << reason;
}

TEST_F(SelfIntersectionControllerTest, LooksOnceMoreAtRestAndAtALimit) {
  SelfIntersectionController controller(5);
  EXPECT_EQ(answer(controller, 7, 1.9, &Controller::respond_to_rest), "nothing");
  EXPECT_NE(answer(controller, 8, 2.3, &Controller::respond_to_rest), "nothing");
  EXPECT_NE(answer(controller, 8, 2.3, &Controller::respond_to_limit), "nothing");
}

TEST_F(SelfIntersectionControllerTest, RefusesAStartThatCutsItself) {
  SelfIntersectionController controller(5);
  EXPECT_TRUE(answer(controller, 0, 2.3).ends_with("as at the start"));
}

}  // namespace
}  // namespace vesica::relax
