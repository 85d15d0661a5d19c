#include "vesica/relax/mesh_controller.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "controller_test.hpp"
#include "relaxation_cases.hpp"
#include "vesica/relax/remesh.hpp"

namespace vesica::relax {
namespace {

/// A single-phase unit sphere whose longest edge is a chosen multiple of its wanted size; all else
/// that a controller looks at is made up.
class MeshControllerTest : public ControllerTest {
 protected:
  MeshControllerTest() {
    model_.is_two_phase = false;
    state_ = test::start_on(test::make_sphere(2));
    diagnostics_.quality = 0.5;
    diagnostics_.velocity.normal_rigid_free = 1;
    options_.max_size = 100;
    options_.max_nodes = 1000000;
    set_relative_edge(1);
    options_.final_curvature_angle = options_.curvature_angle;
  }

  /// Sizes on a sphere are proportional to the angle.
  void set_relative_edge(double ratio) { options_.curvature_angle = edge_for_unit_angle() / ratio; }

  [[nodiscard]] double edge_for_unit_angle() const {
    adapt::SizeFieldOptions unit;
    unit.curvature_angle = 1;
    unit.max_size = 100;
    return adapt::longest_relative_edge({state_.triangulation, state_.values.positions},
                                        wanted_sizes(model_, state_, unit, 1e9));
  }

  /// First step at which a controller asks for a mesh, of those up to 20.
  std::optional<long> first_request() {
    MeshController controller(options_, model_, scales_);
    for (long step = 0; step <= 20; ++step) {
      if (!controller.respond(view_at(step)).empty()) return step;
    }
    return std::nullopt;
  }

  AdaptionOptions options_;
};

TEST_F(MeshControllerTest, LeavesAMeshThatFitsAlone) { EXPECT_EQ(first_request(), std::nullopt); }

TEST_F(MeshControllerTest, ChangesLongEdgesAfterEightSteps) {
  set_relative_edge(1.95);
  EXPECT_EQ(first_request(), 8);
  set_relative_edge(1.85);
  EXPECT_EQ(first_request(), std::nullopt);
}

TEST_F(MeshControllerTest, DoesNotWaitWithMuchTooLongEdges) {
  set_relative_edge(2.25);
  EXPECT_EQ(first_request(), 1);
}

TEST_F(MeshControllerTest, ChangesAMeshWithFarTooManyNodes) {
  set_relative_edge(0.65);  // 0.42 of the nodes
  EXPECT_EQ(first_request(), 8);
  set_relative_edge(0.9);
  EXPECT_EQ(first_request(), std::nullopt);
}

TEST_F(MeshControllerTest, ChangesAMeshWhoseQualityFell) {
  MeshController controller(options_, model_, scales_);
  EXPECT_TRUE(controller.respond(view_at(0)).empty());
  diagnostics_.quality = 0.31;
  EXPECT_TRUE(controller.respond(view_at(9)).empty());
  diagnostics_.quality = 0.29;
  EXPECT_EQ(controller.respond(view_at(10)).size(), 1U);
}

TEST_F(MeshControllerTest, AcceptsALowQualityThatWasThereFromTheStart) {
  diagnostics_.quality = 0.35;
  MeshController controller(options_, model_, scales_);
  EXPECT_TRUE(controller.respond(view_at(0)).empty());
  diagnostics_.quality = 0.28;  // more than 0.75 * 0.35
  EXPECT_TRUE(controller.respond(view_at(9)).empty());
}

TEST_F(MeshControllerTest, WaitsAgainAfterAChange) {
  set_relative_edge(2);
  MeshController controller(options_, model_, scales_);
  for (long step = 0; step <= 30; ++step)
    EXPECT_EQ(controller.respond(view_at(step)).empty(), step == 0 || step % 8 != 0) << step;
}

TEST_F(MeshControllerTest, AsksOnceForTheFineMeshNearTheEquilibrium) {
  scales_ = {2, 3};  // unit of the velocity: energy / length^2
  options_.max_size = 50;
  options_.final_curvature_angle = 0.9 * options_.curvature_angle;
  MeshController controller(options_, model_, scales_);
  diagnostics_.velocity.normal_rigid_free = 0.031 * 0.75;
  EXPECT_TRUE(controller.respond(view_at(9)).empty());
  diagnostics_.velocity.normal_rigid_free = 0.029 * 0.75;
  const auto requests = controller.respond(view_at(10));
  ASSERT_EQ(requests.size(), 1U);
  const auto& plan = std::get<Remesh>(requests.front()).plan;
  const auto& sizes = std::get<adapt::SizeFieldOptions>(plan);
  EXPECT_EQ(sizes.curvature_angle, options_.final_curvature_angle);
  EXPECT_EQ(sizes.interface_size, options_.final_interface_size);
  EXPECT_EQ(sizes.max_size, 100);
  EXPECT_TRUE(controller.respond(view_at(30)).empty());
}

TEST_F(MeshControllerTest, DoesNotEndOnACoarseMesh) {
  MeshController controller(options_, model_, scales_);
  EXPECT_EQ(controller.respond_to_rest(view_at(3)).size(), 1U);
  EXPECT_TRUE(controller.respond_to_rest(view_at(6)).empty());
}

TEST_F(MeshControllerTest, LeavesLongEdgesOfAFineMeshAloneNearRest) {
  const auto asks_with = [this](double ratio, double speed) {
    options_.final_curvature_angle = edge_for_unit_angle() / ratio;
    MeshController controller(options_, model_, scales_);
    EXPECT_EQ(controller.respond_to_rest(view_at(3)).size(), 1U);
    diagnostics_.velocity.normal_rigid_free = speed;
    return !controller.respond(view_at(11)).empty();
  };
  EXPECT_TRUE(asks_with(2.9, 0.031));
  EXPECT_FALSE(asks_with(2.9, 0.029));
  EXPECT_TRUE(asks_with(3.1, 0.029));
}

TEST_F(MeshControllerTest, GoesBackToTheCoarseMeshWhenTheVesicleMovesAgain) {
  options_.final_curvature_angle = 0.4 * options_.curvature_angle;
  MeshController controller(options_, model_, scales_);
  ASSERT_EQ(controller.respond_to_rest(view_at(3)).size(), 1U);
  diagnostics_.velocity.normal_rigid_free = 0.29;
  ASSERT_EQ(controller.respond(view_at(11)).size(), 1U);  // edges are 2.5 of the fine sizes
  diagnostics_.velocity.normal_rigid_free = 0.31;
  EXPECT_TRUE(controller.respond(view_at(20)).empty());
}

TEST_F(MeshControllerTest, GivesUpAfterFiveFailures) {
  MeshController controller(options_, model_, scales_);
  for (int failure = 0; failure < 5; ++failure)
    EXPECT_EQ(controller.respond_to_failure(view_at(3)).size(), 1U);
  EXPECT_TRUE(controller.respond_to_failure(view_at(3)).empty());
}

/// The same for a minimiser: a distance to the minimum in place of a velocity.
class MeshControllerOfAMinimiser : public MeshControllerTest {
 protected:
  StepView view_at_distance(long step, double distance) {
    report_.gradient = distance;
    return view_at(step);
  }
  /// Puts a controller on the fine mesh, at step 10.
  void refine(MeshController& controller) {
    ASSERT_EQ(controller.respond(view_at_distance(10, 9e-3)).size(), 1U);
  }
};

TEST_F(MeshControllerOfAMinimiser, WaitsTwoStepsBetweenChanges) {
  set_relative_edge(2);
  MeshController controller(options_, model_, scales_);
  for (long step = 0; step <= 9; ++step) {
    EXPECT_EQ(controller.respond(view_at_distance(step, 5)).empty(), step == 0 || step % 2 != 0)
        << step;
  }
}

TEST_F(MeshControllerOfAMinimiser, AsksOnceForTheFineMeshWithinAHundredthOfTheMinimum) {
  options_.final_curvature_angle = 0.9 * options_.curvature_angle;
  MeshController controller(options_, model_, scales_);
  diagnostics_.velocity.normal_rigid_free = 1e-6;  // says nothing
  EXPECT_TRUE(controller.respond(view_at_distance(9, 1.1e-2)).empty());
  const auto requests = controller.respond(view_at_distance(10, 9e-3));
  ASSERT_EQ(requests.size(), 1U);
  const auto& plan = std::get<Remesh>(requests.front()).plan;
  EXPECT_EQ(std::get<adapt::SizeFieldOptions>(plan).curvature_angle,
            options_.final_curvature_angle);
  EXPECT_TRUE(controller.respond(view_at_distance(20, 9e-3)).empty());
}

TEST_F(MeshControllerOfAMinimiser, KeepsTheFineMeshNearTheMinimumWhateverItsEdges) {
  options_.final_curvature_angle = edge_for_unit_angle() / 3.1;
  MeshController controller(options_, model_, scales_);
  refine(controller);
  EXPECT_TRUE(controller.respond(view_at_distance(20, 9e-3)).empty());
  EXPECT_EQ(controller.respond(view_at_distance(21, 1.1e-2)).size(), 1U);
}

TEST_F(MeshControllerOfAMinimiser, GoesBackToTheCoarseMeshFarFromTheMinimum) {
  options_.final_curvature_angle = edge_for_unit_angle() / 2.5;
  MeshController controller(options_, model_, scales_);
  refine(controller);
  EXPECT_EQ(controller.respond(view_at_distance(12, 0.29)).size(), 1U);
  EXPECT_TRUE(controller.respond(view_at_distance(14, 0.31)).empty());
}

TEST_F(MeshControllerOfAMinimiser, GivesUpTheFineMeshThatNoLongerFitsAfterASaddle) {
  options_.final_curvature_angle = edge_for_unit_angle() / 3.1;
  for (const double nearest : {1.1e-3, 9e-4}) {
    MeshController controller(options_, model_, scales_);
    refine(controller);
    EXPECT_TRUE(controller.respond(view_at_distance(12, nearest)).empty());
    const auto requests = controller.respond(view_at_distance(13, 1.1e-2));
    ASSERT_EQ(requests.size(), 1U);
    const auto& plan = std::get<Remesh>(requests.front()).plan;
    EXPECT_EQ(std::get<adapt::SizeFieldOptions>(plan).curvature_angle,
              nearest < 1e-3 ? options_.curvature_angle : options_.final_curvature_angle);
  }
}

TEST_F(MeshControllerOfAMinimiser, TakesNoFailureAtTheMinimumForOneOfTheFineMesh) {
  MeshController controller(options_, model_, scales_);
  EXPECT_EQ(controller.respond_to_failure(view_at_distance(5, 9e-4)).size(), 1U);
  refine(controller);
  EXPECT_EQ(controller.respond_to_failure(view_at_distance(20, 1.1e-3)).size(), 1U);
  EXPECT_TRUE(controller.respond_to_failure(view_at_distance(20, 9e-4)).empty());
}

}  // namespace
}  // namespace vesica::relax
